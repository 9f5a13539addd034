/* Finds the contacts of a mesh sequence: frames as OBJ files of the same triangles.
 *
 *   frames [--float] FRAME.obj FRAME.obj...
 *
 * Prints a line for each step between two frames, and one for each of its contacts. Of OBJ it reads only "v x y z" and triangles
 * "f a b c".
 */
#include <selvedge.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct frame {
  double *positions;
  uint32_t *triangles;
  size_t vertex_count, triangle_count;
};

/* Room for three more numbers; it grows by doubling. */
static void *room(void *items, size_t count, size_t size) {
  if ((count & (count - 1)) != 0) return items;
  void *more = realloc(items, (count == 0 ? 1 : 2 * count) * 3 * size);
  if (!more) {
    fprintf(stderr, "out of memory\n");
    exit(1);
  }
  return more;
}

static struct frame read_frame(const char *path) {
  struct frame frame = {NULL, NULL, 0, 0};
  FILE *file = fopen(path, "r");
  if (!file) {
    perror(path);
    exit(1);
  }
  char line[512];
  while (fgets(line, sizeof line, file)) {
    char *at = line + 2;
    if (strncmp(line, "v ", 2) == 0) {
      frame.positions = room(frame.positions, frame.vertex_count, sizeof *frame.positions);
      for (size_t k = 0; k < 3; k++) frame.positions[3 * frame.vertex_count + k] = strtod(at, &at);
      frame.vertex_count++;
    } else if (strncmp(line, "f ", 2) == 0) {
      frame.triangles = room(frame.triangles, frame.triangle_count, sizeof *frame.triangles);
      for (size_t k = 0; k < 3; k++) {
        /* OBJ counts from 1. A word that is no number becomes 2^32 - 1, which the library rejects. */
        frame.triangles[3 * frame.triangle_count + k] = (uint32_t)strtoul(at, &at, 10) - 1;
        at += strcspn(at, " \n"); /* "a/b/c": the position comes first */
      }
      frame.triangle_count++;
    }
  }
  fclose(file);
  return frame;
}

static float *to_float(const struct frame *frame) {
  float *positions = malloc((3 * frame->vertex_count + 1) * sizeof *positions);
  if (!positions) exit(1);
  for (size_t k = 0; k < 3 * frame->vertex_count; k++) positions[k] = (float)frame->positions[k];
  return positions;
}

/* The whole sequence has one detector, which keeps data from the last step: this makes the next step faster. */
static selvedge_status find(selvedge_detector *detector, int is_float, const struct frame *start, const struct frame *end,
                            const selvedge_contact **contacts, size_t *count) {
  if (!is_float) {
    return selvedge_detector_contacts_f64(detector, start->positions, end->positions, start->vertex_count, contacts, count);
  }
  float *a = to_float(start), *b = to_float(end);
  selvedge_status status = selvedge_detector_contacts_f32(detector, a, b, start->vertex_count, contacts, count);
  free(a);
  free(b);
  return status;
}

int main(int argc, char **argv) {
  int is_float = argc > 1 && strcmp(argv[1], "--float") == 0, first = 1 + is_float;
  if (argc - first < 2) {
    fprintf(stderr, "usage: %s [--float] FRAME.obj FRAME.obj...\n", argv[0]);
    return 2;
  }
  struct frame start = read_frame(argv[first]);
  selvedge_detector *detector = NULL;
  uint32_t scalar = is_float ? SELVEDGE_SCALAR_F32 : SELVEDGE_SCALAR_F64;
  selvedge_status status =
      selvedge_detector_new(scalar, start.vertex_count, start.triangles, start.triangle_count, &detector);

  for (int k = first + 1; k < argc && status == SELVEDGE_STATUS_OK; k++) {
    struct frame end = read_frame(argv[k]);
    if (start.vertex_count != end.vertex_count) {
      /* The library takes one count for both. */
      fprintf(stderr, "the start frame has %zu positions, the end frame %zu\n", start.vertex_count, end.vertex_count);
      exit(1);
    }
    const selvedge_contact *contacts = NULL; /* the detector's: until the next step */
    size_t count = 0;
    status = find(detector, is_float, &start, &end, &contacts, &count);
    if (status == SELVEDGE_STATUS_OK) printf("%s: %zu contacts\n", argv[k], count);
    for (size_t c = 0; c < count; c++) {
      const uint32_t *vertices = contacts[c].vertices;
      printf("%s %u %u vertices %u %u %u %u time %.17g\n",
             contacts[c].kind == SELVEDGE_KIND_VERTEX_FACE ? "vertex-face" : "edge-edge", contacts[c].pair.first,
             contacts[c].pair.second, vertices[0], vertices[1], vertices[2], vertices[3], contacts[c].time);
    }
    free(start.positions);
    free(start.triangles);
    start = end;
  }
  if (status != SELVEDGE_STATUS_OK) {
    fprintf(stderr, "%s: %s: %s\n", argv[0], selvedge_status_string(status), selvedge_last_error());
  }
  selvedge_detector_free(detector);
  free(start.positions);
  free(start.triangles);
  return status == SELVEDGE_STATUS_OK ? 0 : 1;
}
