#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: window_picture.py DUMP FILE.png   an X window dump as PNG; fails if it is not the picture of a wall."""
import struct
import sys
import zlib

MOST_OF_ONE_COLOUR = 0.5  # share of the picture
LEAST_COLOURS = 2000


def main(dump, file):
    with open(dump, "rb") as opened:
        data = opened.read()
    header, _, _, _, width, height = struct.unpack_from(">6I", data)
    bytes_per_line, colours = struct.unpack_from(">I", data, 48)[0], struct.unpack_from(">I", data, 76)[0]
    begin = header + 12 * colours
    rows = []
    count = {}
    for y in range(height):
        line = data[begin + y * bytes_per_line : begin + y * bytes_per_line + 4 * width]
        pixels = bytearray(3 * width)
        pixels[0::3], pixels[1::3], pixels[2::3] = line[2::4], line[1::4], line[0::4]
        rows.append(b"\0" + bytes(pixels))
        for x in range(0, len(line), 4):
            colour = line[x : x + 3]
            count[colour] = count.get(colour, 0) + 1

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    with open(file, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)))
        out.write(chunk(b"IDAT", zlib.compress(b"".join(rows), 6)) + chunk(b"IEND", b""))
    share = max(count.values()) / (width * height)
    print(f"{file}: {width}x{height}, {len(count)} colours, {share:.0%} of one")
    if len(count) < LEAST_COLOURS or share > MOST_OF_ONE_COLOUR:
        sys.exit("error: this is no picture of a wall")


main(*sys.argv[1:])
