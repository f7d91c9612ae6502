# SPDX-License-Identifier: MIT
"""Writes files of some kilobytes or megabytes that stand for gigabytes or hours, for made_inputs.py, as made_files.py does.

Each of these took more than 20 s or 1.5 GB once, or is like one that did."""
import base64
import json
import os
import struct
import zlib

from made_files import ROOT, put, script

PRIME = 712697  # buckets of a table of hashes: numbers at this distance shared one


def zeros(count):
    """So many zero bytes, packed."""
    packer, part = zlib.compressobj(9), b"\0" * 1000000
    return b"".join(packer.compress(part[:min(len(part), count - i)]) for i in range(0, count, len(part))) + packer.flush()


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, data, more=b"", interlaced=0):
    header = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 1, 0, 0, 0, interlaced))
    return b"\x89PNG\r\n\x1a\n" + header + more + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def jpeg(side, scans):
    """A progressive picture whose scans of some bytes go through all blocks."""
    def segment(marker, data):
        return bytes([0xff, marker]) + struct.pack(">H", len(data) + 2) + data

    def table(kind, symbol):
        return segment(0xc4, kind + bytes([1] + [0] * 15) + symbol)

    blocks = (side // 8) ** 2
    bits = ("0" + "10" * 7) * (blocks // 27306 + 2)  # runs of 27,306 blocks
    bits += "0" * (-len(bits) % 8)
    scan = segment(0xda, b"\1\1\0\1\x3f\0") + int(bits, 2).to_bytes(len(bits) // 8, "big")
    return (b"\xff\xd8" + segment(0xdb, b"\0" + b"\1" * 64) + segment(0xc2, struct.pack(">BHHB", 8, side, side, 1) + b"\1\x11\0") +
            table(b"\0", b"\0") + table(b"\x10", b"\xe0") + segment(0xda, b"\1\1\0\0\0\0") + b"\0" * (blocks // 8 + 2) + scan * scans + b"\xff\xd9")


def pictures(folder):
    small = zlib.compress(b"\0" * 48)
    return put(folder, {
        "side.png": png(30000, 30000, small), "million.png": png(999999, 999999, small), "rows.png": png(16, 16, zeros(1000000000)),
        "interlaced.png": png(9999, 9999, zeros(30000000), interlaced=1),
        "text.png": png(16, 16, small, chunk(b"zTXt", b"a\0\0" + zeros(1500000000))),
        "profile.png": png(16, 16, small, chunk(b"iCCP", b"a\0\0" + zeros(1500000000))),
        "chunks.png": png(16, 16, small, chunk(b"tEXt", b"a\0b") * 500000), "scans.jpg": jpeg(4000, 40000)})


def textured(folder):
    """A triangle for each of these pictures."""
    out = {}
    for name in pictures(folder):
        put(folder, {name + ".mtl": f"newmtl skin\nmap_Kd {name}\n"})
        out |= put(folder, {name + ".obj": f"mtllib {name}.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"})
    return out


def lights(folder):
    def hdr(width, height, value=100):
        runs = b"".join(bytes([128 + min(127, width - x), value]) for x in range(0, width, 127))
        return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + (struct.pack(">BBH", 2, 2, width) + runs * 4) * height

    made = {"large": hdr(16384, 8192), "bright": hdr(64, 32, 255), "lines": b"#?RADIANCE\n" + b"A=1\n" * 3000000}
    put(folder, {name + ".hdr": data for name, data in made.items()})
    return put(folder, {name + ".json": script(view={"width_px": 16, "height_px": 16, "light": {"file": name + ".hdr"}}) for name in made})


def checksum(data, polynomial, bits):
    value = 0
    for byte in data:
        value ^= byte << (bits - 8)
        for _ in range(8):
            value = ((value << 1) ^ (polynomial if value >> (bits - 1) else 0)) & ((1 << bits) - 1)
    return value


def flac(frames, said):
    """Silence of eight channels; `said`: samples by the header."""
    length = 65535
    info = struct.pack(">HH", length, length) + bytes(6) + (48000 << 44 | 7 << 41 | 15 << 36 | said).to_bytes(8, "big") + bytes(16)
    parts = [b"fLaC\x80" + len(info).to_bytes(3, "big") + info]
    for i in range(frames):
        head = b"\xff\xf8\x7a\x78" + chr(i).encode("utf-8", "surrogatepass") + struct.pack(">H", length - 1)
        frame = head + bytes([checksum(head, 7, 8)]) + bytes(24)
        parts.append(frame + struct.pack(">H", checksum(frame, 0x8005, 16)))
    return b"".join(parts)


def long_sounds(folder):
    out = put(folder, {
        "silence.flac": flac(20000, 20000 * 65535), "liar.flac": flac(20000, 1), "unknown.flac": flac(20000, 0), "promise.flac": flac(3, 2 ** 36 - 1),
        "itself.wav": "ffconcat version 1.0\n" + "file itself.wav\n" * 100, "list.wav": "#EXTM3U\n#EXTINF:1,\nlist.wav\n",
        "days.wav": b"RIFF\xff\xff\xff\xffWAVEfmt " + struct.pack("<IHHIIHH", 16, 1, 1, 48000, 96000, 2, 16) + b"data" + struct.pack("<I", 0xfffffff0)})
    os.truncate(out["days.wav"], 0xfffffff0 + 44)  # takes no disk
    return out


def packed_tets(folder):
    def array(name, body, more='format="binary"'):
        return f'<DataArray type="Int8" Name="{name}" {more}>{body}</DataArray>'

    def vtu(cells, section, packed=' compressor="vtkZLibDataCompressor"', tail=b""):
        return (f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"{packed}><UnstructuredGrid><Piece NumberOfPoints="4" '
                f'NumberOfCells="{cells}">{section}</Piece></UnstructuredGrid>').encode() + tail + b"</VTKFile>"

    def block(sizes, data):
        return base64.b64encode(struct.pack(f"<{len(sizes)}I", *sizes)).decode() + base64.b64encode(data).decode()

    many, empty, nodes = zeros(1000000000), zlib.compress(b""), 400000
    again = array("connectivity", "", 'format="appended" offset="0"') * 20000
    data = b'<AppendedData encoding="raw">_' + struct.pack("<I", 20000000) + bytes(20000000) + b"</AppendedData>"
    files = {
        "cells.vtu": vtu(30000000, "<Cells>" + array("connectivity", block([1, 1000000000, 0, len(many)], many)) + "</Cells>"),
        "again.vtu": vtu(1, "<Cells>" + again + "</Cells>", "", data),
        "empty.vtu": vtu(1, "<Cells>" + array("connectivity", block([300000, 0, 0] + [len(empty)] * 300000, empty * 300000)) + "</Cells>"),
        "equal.ele": f"1 4 0\n1 0 {PRIME} {97 * PRIME} {9409 * PRIME}\n",
        "equal.node": f"{nodes} 3 0 0\n" + "".join(f"{i * PRIME} {i % 97} {i // 97 % 97} {i // 9409}\n" for i in range(nodes))}
    put(folder, files)
    experiment = json.loads((ROOT / "samples/figures/mesh/experiment.json").read_text())
    made = {}
    for name in files.keys() - {"equal.node"}:
        experiment["body"]["mesh"]["file"] = name
        made[name + ".json"] = json.dumps(experiment)
    return put(folder, made)


def much_of_little(folder):
    """Meshes and a rig."""
    vertices, rig = 400000, json.loads((ROOT / "rigs/adult/rig.json").read_text())
    rig["tissue"] = {"collagen": [{"at": "prn", "radius_mm": 200, "from": "n", "to": "gn", "k1_pa": 1e7}] * 9000}
    faces = "".join(f"f {i} {i + 1} {i + 2}\n" for i in range(1, vertices - 1, 3))
    return put(folder, {
        "line.obj": "".join(f"v {i * PRIME * 1e-9:.9f} 0 0\n" for i in range(vertices)) + faces,
        "collagen.json": json.dumps(rig).replace('"../../', f'"{ROOT}/').replace('"../', f'"{ROOT}/rigs/')})
