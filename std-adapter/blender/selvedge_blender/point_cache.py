"""PC2 files: the positions of one object, frame by frame."""

import os

import bpy
import numpy as np

from .meshes import CACHE

_HEADER = np.dtype([("magic", "S12"), ("version", "<i4"), ("vertices", "<i4"), ("start", "<f4"), ("rate", "<f4"), ("samples", "<i4")])


class PointCache:
    """A file that grows by a sample a frame. The samples so far play at any time after :meth:`close`, so a cancelled run does too."""

    def __init__(self, path, vertices, start, samples=0):
        """Opens the file for samples after the first ``samples`` ones, which stay."""
        os.makedirs(os.path.dirname(path), exist_ok=True)
        self.path, self.vertices, self.start, self.samples = path, vertices, start, samples
        self.file = open(path, "r+b" if samples else "wb")
        self._write_header()
        self.file.truncate(_HEADER.itemsize + samples * vertices * 12)

    def _write_header(self):
        self.file.seek(0)
        self.file.write(np.array((b"POINTCACHE2", 1, self.vertices, self.start, 1.0, self.samples), _HEADER).tobytes())

    def add(self, positions):
        """Appends the positions of a frame, in local space."""
        self.file.seek(0, os.SEEK_END)
        self.file.write(np.ascontiguousarray(positions, "<f4").tobytes())
        self.samples += 1

    def close(self):
        self._write_header()
        self.file.close()


def read_sample(path, frame):
    """Returns the positions of a frame in local space, and the number of samples up to it; None if the file has no such frame."""
    try:
        with open(path, "rb") as file:
            header = np.frombuffer(file.read(_HEADER.itemsize), _HEADER)[0]
            index = round(frame - float(header["start"]))
            if not 0 <= index < header["samples"]:
                return None
            size = 12 * int(header["vertices"])
            file.seek(_HEADER.itemsize + index * size)
            return np.frombuffer(file.read(size), "<f4").reshape(-1, 3).astype(np.float64), index + 1
    except (OSError, IndexError, ValueError):
        return None


def path_of(scene, obj):
    """The file of an object's result: beside the saved file, otherwise in Blender's temporary folder."""
    folder = bpy.path.abspath(scene.selvedge.folder)
    if folder.startswith("//") or not os.path.isabs(folder):
        folder = os.path.join(bpy.app.tempdir, "selvedge")
    return os.path.join(folder, bpy.path.clean_name(obj.name) + ".pc2")


def play(obj, path, start):
    """Plays a file after all modifiers that were the input of the simulation. Returns the later modifiers that change the surface."""
    modifier = obj.modifiers.get(CACHE) or obj.modifiers.new(CACHE, "MESH_CACHE")
    modifier.cache_format, modifier.filepath = "PC2", path
    modifier.deform_mode, modifier.interpolation = "OVERWRITE", "LINEAR"
    modifier.time_mode, modifier.play_mode, modifier.frame_start = "FRAME", "SCENE", start
    # Y forward and Z up are Blender's own axes: nothing is converted.
    modifier.forward_axis, modifier.up_axis = "POS_Y", "POS_Z"
    modifier.show_viewport = modifier.show_render = True
    after = list(obj.modifiers)[obj.modifiers.find(CACHE) + 1 :]
    return [each.name for each in after if each.show_viewport]
