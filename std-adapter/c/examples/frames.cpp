// Finds the contacts of a mesh sequence: frames as OBJ files of the same triangles.
//
//   frames [--float] FRAME.obj FRAME.obj...
//
// Prints a line for each step between two frames, and one for each of its contacts. Of OBJ it reads only "v x y z" and triangles
// "f a b c".
#include <selvedge.hpp>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

template <class Scalar>
struct frame {
  std::vector<Scalar> positions;
  std::vector<std::uint32_t> triangles;
};

template <class Scalar>
frame<Scalar> read_frame(const std::string &path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  frame<Scalar> read;
  for (std::string line, word, number; std::getline(file, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      for (int k = 0; k < 3 && words >> number; k++) read.positions.push_back(static_cast<Scalar>(std::stod(number)));
    } else if (word == "f") {
      // OBJ counts from 1. In "a/b/c" the position comes first, and reading ends behind it.
      for (int k = 0; k < 3 && words >> number; k++) read.triangles.push_back(static_cast<std::uint32_t>(std::stoul(number)) - 1);
    }
  }
  return read;
}

template <class Scalar>
void find_contacts(const std::vector<std::string> &paths) {
  auto start = read_frame<Scalar>(paths.front());
  selvedge::detector<Scalar> detector(start.positions.size() / 3, start.triangles);
  for (std::size_t step = 1; step < paths.size(); step++) {
    auto end = read_frame<Scalar>(paths[step]);
    const auto contacts = detector.contacts(start.positions, end.positions);  // valid until the next step
    std::printf("%s: %zu contacts\n", paths[step].c_str(), contacts.size());
    for (const selvedge_contact &contact : contacts) {
      const auto *vertices = contact.vertices;
      std::printf("%s %u %u vertices %u %u %u %u time %.17g\n",
                  contact.kind == SELVEDGE_KIND_VERTEX_FACE ? "vertex-face" : "edge-edge", contact.pair.first,
                  contact.pair.second, vertices[0], vertices[1], vertices[2], vertices[3], contact.time);
    }
    start = std::move(end);
  }
}

int main(int argc, char **argv) {
  std::vector<std::string> paths(argv + 1, argv + argc);
  const bool is_float = !paths.empty() && paths.front() == "--float";
  if (is_float) paths.erase(paths.begin());
  if (paths.size() < 2) {
    std::cerr << "usage: " << argv[0] << " [--float] FRAME.obj FRAME.obj...\n";
    return 2;
  }
  try {
    is_float ? find_contacts<float>(paths) : find_contacts<double>(paths);
  } catch (const std::exception &failed) {
    std::cerr << argv[0] << ": " << failed.what() << '\n';
    return 1;
  }
}
