"""Prints the texels of a small OpenEXR file: red, green, blue of each, row by row, a texel a line.

Reads what https://openexr.com/en/latest/OpenEXRFileLayout.html says of a single part of scan lines compressed with ZIP,
with the channels B, G, R of one type. Written for the test `lut::exr_is_read_back_to_the_last_bit`.
"""

import struct
import sys
import zlib

data = open(sys.argv[1], "rb").read()
assert data[:8] == b"\x76\x2f\x31\x01\x02\0\0\0", "not a plain OpenEXR file"


def word(at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


at, attributes = 8, {}
while data[at]:
    name, at = word(at)
    _, at = word(at)
    (size,) = struct.unpack_from("<i", data, at)
    attributes[name] = data[at + 4 : at + 4 + size]
    at += 4 + size
left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
width, height = right - left + 1, bottom - top + 1
channels = attributes["channels"]
kind = {1: "e", 2: "f"}[struct.unpack_from("<i", channels, 2)[0]]
assert [channels[i] for i in (0, 18, 36)] == list(b"BGR") and attributes["compression"] == b"\x03"
size = struct.calcsize(kind)
for place in struct.unpack_from(f"<{-(-height // 16)}Q", data, at + 1):
    y, packed = struct.unpack_from("<ii", data, place)
    lines = min(16, bottom - y + 1)
    whole = 3 * size * width * lines
    block = data[place + 8 : place + 8 + packed]
    if packed < whole:
        coded = bytearray(zlib.decompress(block))
        for i in range(1, whole):
            coded[i] = (coded[i - 1] + coded[i] - 128) & 255
        block = bytearray(whole)
        block[0::2], block[1::2] = coded[: (whole + 1) // 2], coded[(whole + 1) // 2 :]
    for line in range(lines):
        values = struct.unpack_from(f"<{3 * width}{kind}", block, 3 * size * width * line)
        blue, green, red = (values[i * width : (i + 1) * width] for i in range(3))
        for texel in zip(red, green, blue):
            print(*(repr(value) for value in texel))
