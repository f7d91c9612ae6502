# SPDX-License-Identifier: MIT
"""A strict reader of VTK's XML files (.vtu, .vtp, .pvd), without VTK: it accepts only what the format says.

Source: VTK File Formats, in The VTK User's Guide, Kitware, 11th edition, 2010.
"""
import pathlib
import re
import struct
import xml.etree.ElementTree as ElementTree

TYPES = {"Float64": ("d", 8, float), "Int64": ("q", 8, int), "UInt8": ("B", 1, int)}
CELL_POINTS = {3: 2, 5: 3, 10: 4, 12: 8}  # line, triangle, tetrahedron, hexahedron


class VtkError(Exception):
    pass


def demand(true, what):
    if not true:
        raise VtkError(what)


class Reader:
    def __init__(self, file):
        data = pathlib.Path(file).read_bytes()
        self.blocks = None
        begin = data.find(b'<AppendedData encoding="raw">')
        if begin >= 0:
            underscore = data.index(b"_", begin)
            demand(data[begin:underscore].strip() == b'<AppendedData encoding="raw">', "no text before _")
            end = data.rindex(b"</AppendedData>")
            self.blocks = data[underscore + 1:end]
            data = data[:begin] + data[end + len(b"</AppendedData>"):]
        self.root = ElementTree.fromstring(data.decode("ascii"))
        demand(self.root.tag == "VTKFile", "the root is VTKFile")
        demand(self.root.get("byte_order") == "LittleEndian", "little-endian")
        demand(self.root.get("header_type") == "UInt64", "lengths are UInt64")
        demand(self.root.get("version") == "1.0", "version 1.0")
        self.used = []

    def array(self, element):
        demand(element.tag == "DataArray", "a DataArray")
        code, size, convert = TYPES[element.get("type")]
        components = int(element.get("NumberOfComponents", "1"))
        if element.get("format") == "ascii":
            words = element.text.split()
            values = [convert(word) for word in words]
        else:
            demand(element.get("format") == "appended", "ascii or appended")
            demand(not (element.text or "").strip(), "an appended array has no text")
            at = int(element.get("offset"))
            (length,) = struct.unpack_from("<Q", self.blocks, at)
            demand(length % (size * components) == 0, "whole tuples")
            demand(at + 8 + length <= len(self.blocks), "a block inside of the file")
            values = list(struct.unpack_from(f"<{length // size}{code}", self.blocks, at + 8))
            self.used.append((at, at + 8 + length))
        demand(len(values) % components == 0, "whole tuples")
        return components, values

    def arrays(self, parent):
        out = {}
        for element in parent:
            name = element.get("Name")
            demand(name and name not in out, "each array has a name of its own")
            out[name] = self.array(element)
        return out

    def finish(self):
        if self.blocks is None:
            return
        at = 0
        for begin, end in sorted(self.used):
            demand(begin == at, "no gaps between blocks")
            at = end
        demand(self.blocks[at:].strip() == b"", "nothing after the last block")


def read_mesh(file):
    """Returns a dict: points, cells (lists of points), types, point_data, cell_data ({name: (components, values)}), time_s."""
    reader = Reader(file)
    kind = reader.root.get("type")
    demand({".vtu": "UnstructuredGrid", ".vtp": "PolyData"}[pathlib.Path(file).suffix] == kind, "type and ending agree")
    demand([child.tag for child in reader.root] == [kind], "one data set")
    data_set = reader.root[0]
    field, piece = list(data_set)
    demand((field.tag, piece.tag) == ("FieldData", "Piece"), "field data and one piece")
    fields = reader.arrays(field)
    points_expected = int(piece.get("NumberOfPoints"))
    cells_element = "Cells" if kind == "UnstructuredGrid" else "Polys"
    cells_expected = int(piece.get("NumberOfCells" if kind == "UnstructuredGrid" else "NumberOfPolys"))
    parts = {child.tag: child for child in piece}
    demand(set(parts) == {"PointData", "CellData", "Points", cells_element}, "the parts of a piece")
    mesh = {"time_s": fields["TimeValue"][1][0]}
    components, coordinates = reader.array(parts["Points"][0])
    demand(components == 3 and len(coordinates) == 3 * points_expected, "three coordinates a point")
    mesh["points"] = [tuple(coordinates[i:i + 3]) for i in range(0, len(coordinates), 3)]
    for key, element, rows in (("point_data", "PointData", points_expected), ("cell_data", "CellData", cells_expected)):
        mesh[key] = reader.arrays(parts[element])
        for name, (components, values) in mesh[key].items():
            demand(len(values) == components * rows, f"{name}: one tuple a row")
            demand(all(value == value and abs(value) < 1e300 for value in values), f"{name}: finite")
    cells = reader.arrays(parts[cells_element])
    connectivity, offsets = cells["connectivity"][1], cells["offsets"][1]
    demand(len(offsets) == cells_expected, "an end for each cell")
    mesh["types"] = cells["types"][1] if kind == "UnstructuredGrid" else [5] * cells_expected
    demand(len(mesh["types"]) == cells_expected, "a type for each cell")
    mesh["cells"] = []
    at = 0
    for end, cell_type in zip(offsets, mesh["types"]):
        demand(end - at == CELL_POINTS[cell_type], "as many points as the type says")
        mesh["cells"].append(connectivity[at:end])
        at = end
    demand(at == len(connectivity), "no point left over")
    demand(all(0 <= point < points_expected for point in connectivity), "points that are there")
    reader.finish()
    return mesh


def read_series(file):
    """Returns a list of (time_s, part, path); every file is there."""
    root = ElementTree.parse(file).getroot()
    demand((root.tag, root.get("type")) == ("VTKFile", "Collection"), "a collection")
    out = []
    for entry in root[0]:
        demand(entry.tag == "DataSet", "data sets only")
        path = pathlib.Path(file).parent / entry.get("file")
        demand(path.is_file(), f"{path} is there")
        demand(re.fullmatch(r"[a-z]+_\d{4,}\.vt[up]", path.name) is not None, "names of the series")
        out.append((float(entry.get("timestep")), int(entry.get("part")), path))
    return out
