#!/usr/bin/env python3
"""Turns the screen of an Xvfb (its -fbdir file, in xwd's format) into a small PNG with a palette.

screen_to_png.py SCREEN OUT.png [X Y WIDTH HEIGHT]
"""

import collections
import struct
import sys
import zlib

GREYS = 64


def read_screen(path):
    """Rows of (r, g, b) as three byte strings, from a 32 bit TrueColor xwd."""
    with open(path, "rb") as file:
        data = file.read()
    head = struct.unpack(">25I", data[:100])
    header, width, height, bits, line, colors = head[0], head[4], head[5], head[11], head[12], head[19]
    if bits != 32:
        sys.exit(f"{path}: the screen has {bits} bits a pixel; start Xvfb with a depth of 24")
    first = header + 12 * colors
    rows = []
    for y in range(height):
        row = data[first + y * line : first + y * line + 4 * width]
        rows.append((row[2::4], row[1::4], row[0::4]))
    return width, height, rows


def coarse(pixel):
    """A CT's greys keep six bits, colours four."""
    r, g, b = pixel
    if max(pixel) - min(pixel) < 7:
        return (g >> 2,)
    return (r >> 4, g >> 4, b >> 4)


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b))


def palette_of(counts):
    """256 colours: all greys, and the most frequent others; and each pixel's place among them."""
    greys = [(v * 255 // (GREYS - 1),) * 3 for v in range(GREYS)]
    groups = collections.defaultdict(collections.Counter)
    for pixel, count in counts.items():
        key = coarse(pixel)
        if len(key) == 3:
            groups[key][pixel] += count
    most = sorted(groups.values(), key=lambda group: -sum(group.values()))[: 256 - GREYS]
    colors = greys + [group.most_common(1)[0][0] for group in most]
    place = {}
    for pixel in counts:
        key = coarse(pixel)
        if len(key) == 1:
            place[pixel] = min(GREYS - 1, (pixel[1] * (GREYS - 1) + 127) // 255)
        else:
            place[pixel] = min(range(len(colors)), key=lambda i: distance(colors[i], pixel))
    return colors, place


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def main():
    if len(sys.argv) not in (3, 7):
        sys.exit(__doc__)
    width, height, rows = read_screen(sys.argv[1])
    x, y, w, h = map(int, sys.argv[3:]) if len(sys.argv) == 7 else (0, 0, width, height)
    pixels = [list(zip(*(c[x : x + w] for c in row))) for row in rows[y : y + h]]
    counts = collections.Counter(pixel for row in pixels for pixel in row)
    colors, place = palette_of(counts)
    lines = b"".join(b"\0" + bytes(place[pixel] for pixel in row) for row in pixels)
    with open(sys.argv[2], "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", w, h, 8, 3, 0, 0, 0)))
        file.write(chunk(b"PLTE", b"".join(bytes(color) for color in colors)))
        file.write(chunk(b"IDAT", zlib.compress(lines, 9)))
        file.write(chunk(b"IEND", b""))


main()
