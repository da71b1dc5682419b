"""Reads PNG files as Lucerna writes them."""
import struct
import zlib


def read(data):
    """Width, height, and the pixels row by row, each a tuple; of 8-bit grey or RGB."""
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, bits, colors, _, _, interlaced = struct.unpack_from(">IIBBBBB", data, at + 8)
            assert bits == 8 and colors in (0, 2) and not interlaced
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    channels = 3 if colors == 2 else 1
    length, raw = channels * width, zlib.decompress(packed)
    above, pixels = bytes(length), []
    for y in range(height):
        method, *row = raw[y * (length + 1):(y + 1) * (length + 1)]
        for i, value in enumerate(row):
            left, corner = (row[i - channels], above[i - channels]) if i >= channels else (0, 0)
            nearest = min((left, above[i], corner), key=lambda v: abs(left + above[i] - corner - v))
            row[i] = (value + (0, left, above[i], (left + above[i]) // 2, nearest)[method]) % 256
        pixels += [tuple(row[i:i + channels]) for i in range(0, length, channels)]
        above = row
    return width, height, pixels
