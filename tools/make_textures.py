#!/usr/bin/env python3
"""Makes the pictures that the gallery's scenes are painted with.

    tools/make_textures.py [FOLDER]     (default: scenes/textures)

They are procedural, the same bits each time, and need nothing beyond Python's standard library:

    stars.png   equirectangular night sky with a galaxy's band
    dusk.png    equirectangular evening sky
    tiles.png   4 x 4 stone tiles, repeating
    letters.png 8 x 6 coloured cells, each with its own name: shows what is mirrored, turned, doubled
"""

import math
import pathlib
import random
import struct
import sys
import zlib


def write_png(path, width, height, rows):
    """Rows of RGB bytes, top first; each is stored as its difference to the one above."""
    filtered, above = bytearray(), bytes(3 * width)
    for row in rows:
        filtered.append(2)
        filtered += bytes((a - b) & 255 for a, b in zip(row, above))
        above = row

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(bytes(filtered), 9)) + chunk(b"IEND", b""))


class Noise:
    """Smooth noise in space, 0 to 1: a random value at each whole point, blended between."""

    def __init__(self, seed):
        generator = random.Random(seed)
        self.values = [generator.random() for _ in range(4096)]

    def lattice(self, x, y, z):
        return self.values[(x * 374761 + y * 668265 + z * 974711) & 4095]

    def at(self, x, y, z):
        x0, y0, z0 = math.floor(x), math.floor(y), math.floor(z)
        u, v, w = (f * f * (3 - 2 * f) for f in (x - x0, y - y0, z - z0))
        total = 0.0
        for i, a in ((0, 1 - u), (1, u)):
            for j, b in ((0, 1 - v), (1, v)):
                for k, c in ((0, 1 - w), (1, w)):
                    total += a * b * c * self.lattice(x0 + i, y0 + j, z0 + k)
        return total

    def fractal(self, x, y, z, octaves):
        """Each octave twice as fine and half as strong; 0 to 1."""
        total, weight, strength = 0.0, 0.0, 1.0
        for _ in range(octaves):
            total += strength * self.at(x, y, z)
            weight += strength
            x, y, z, strength = 2.03 * x + 17.1, 2.03 * y + 5.3, 2.03 * z + 9.7, 0.5 * strength
        return total / weight


def sky_direction(column, row, width, height):
    """Direction of an equirectangular picture's pixel: its centre is -z, +x to the right, +y up."""
    azimuth = 2 * math.pi * ((column + 0.5) / width - 0.5)
    elevation = math.pi * (0.5 - (row + 0.5) / height)
    return (math.sin(azimuth) * math.cos(elevation), math.sin(elevation),
            -math.cos(azimuth) * math.cos(elevation))


def mix(a, b, share):
    return tuple(p + (q - p) * share for p, q in zip(a, b))


def clamp(value, low=0.0, high=1.0):
    return min(high, max(low, value))


def smooth(low, high, value):
    t = clamp((value - low) / (high - low))
    return t * t * (3 - 2 * t)


def to_byte(value):
    return int(clamp(value) * 255 + 0.5)


def enlarge(coarse, factor):
    """A picture of float triples, so many times larger, blended between its pixels; it repeats
    from left to right."""
    height, width = len(coarse), len(coarse[0])
    for row in range(height * factor):
        y = clamp((row + 0.5) / factor - 0.5, 0, height - 1)
        upper = min(int(y), height - 2)
        share = y - upper
        blended = [mix(a, b, share) for a, b in zip(coarse[upper], coarse[upper + 1])]
        line = []
        for column in range(width * factor):
            x = (column + 0.5) / factor - 0.5
            left = math.floor(x)
            line.append(mix(blended[left % width], blended[(left + 1) % width], x - left))
        yield line


def stars(path):
    width, height, coarseness = 3072, 1536, 12
    noise, generator = Noise(1), random.Random(2)
    pole = (0.45, 0.62, 0.643)  # of the galaxy's band

    def glow(x, y, z):
        height_over_band = x * pole[0] + y * pole[1] + z * pole[2]
        band = math.exp(-(height_over_band / 0.16) ** 2)
        cloud = noise.fractal(3 * x + 8, 3 * y, 3 * z, 5)
        dust = smooth(0.42, 0.62, noise.fractal(6 * x, 6 * y + 3, 6 * z, 5))
        dust *= math.exp(-(height_over_band / 0.09) ** 2)
        lit = band * (0.25 + 0.9 * cloud) * (1 - 0.75 * dust)
        base = mix((0.012, 0.016, 0.040), (0.030, 0.022, 0.050), cloud)
        return tuple(b + lit * c for b, c in zip(base, (0.52, 0.46, 0.50)))

    coarse = [[glow(*sky_direction(i, j, width // coarseness, height // coarseness))
               for i in range(width // coarseness)] for j in range(height // coarseness)]
    picture = [[list(pixel) for pixel in row] for row in enlarge(coarse, coarseness)]

    for _ in range(9000):
        up = generator.uniform(-1, 1)
        azimuth = generator.uniform(-math.pi, math.pi)
        level = math.sqrt(1 - up * up)
        direction = (math.sin(azimuth) * level, up, -math.cos(azimuth) * level)
        in_band = math.exp(-(sum(a * b for a, b in zip(direction, pole)) / 0.2) ** 2)
        if generator.random() > 0.35 + 0.65 * in_band:
            continue
        brightness = min(2.5, 0.16 * generator.random() ** -0.55)
        warmth = generator.gauss(0, 1)
        color = (1 + 0.16 * warmth, 1.0, 1 - 0.20 * warmth)
        x, y = (azimuth / (2 * math.pi) + 0.5) * width, (0.5 - math.asin(up) / math.pi) * height
        stretch, reach = 1 / max(level, 0.05), 2 + int(1.5 * brightness)
        size = 0.62 + 0.22 * brightness
        for row in range(max(0, int(y) - reach), min(height, int(y) + reach + 1)):
            wide = int(reach * stretch) + 1
            for column in range(int(x) - wide, int(x) + wide + 1):
                across, along = (column + 0.5 - x) / stretch, row + 0.5 - y
                shine = brightness * math.exp(-(across * across + along * along) / (2 * size * size))
                if shine > 0.004:
                    pixel = picture[row][column % width]
                    for channel in range(3):
                        pixel[channel] += shine * color[channel]
    write_png(path, width, height,
              (bytes(to_byte(value) for pixel in row for value in pixel) for row in picture))


def dusk(path):
    width, height, coarseness = 1536, 768, 3
    noise = Noise(3)
    sun = (-0.80, 0.13, -0.585)

    def color(x, y, z):
        high = smooth(-0.02, 0.75, y)
        sky = mix((0.93, 0.68, 0.47), (0.52, 0.60, 0.78), smooth(-0.02, 0.26, y))
        sky = mix(sky, (0.16, 0.27, 0.55), high)
        near = max(0.0, x * sun[0] + y * sun[1] + z * sun[2])
        sky = tuple(s + g * (0.30 * near ** 6 + 0.55 * near ** 90)
                    for s, g in zip(sky, (1.0, 0.75, 0.40)))
        cloud_height = max(y, 0.0) + 0.12  # a layer seen in perspective
        cover = noise.fractal(1.1 * x / cloud_height, 3.0, 1.1 * z / cloud_height, 5)
        cloud = smooth(0.50, 0.72, cover) * smooth(0.0, 0.12, y) * 0.75
        sky = mix(sky, mix((0.98, 0.80, 0.68), (0.80, 0.80, 0.90), high), cloud)
        return mix(sky, (0.40, 0.36, 0.38), smooth(0.10, 0.45, -y))

    coarse = [[color(*sky_direction(i, j, width // coarseness, height // coarseness))
               for i in range(width // coarseness)] for j in range(height // coarseness)]
    write_png(path, width, height, (bytes(to_byte(value) for pixel in row for value in pixel)
                                    for row in enlarge(coarse, coarseness)))


def tiles(path):
    side, count = 512, 4
    noise, generator = Noise(5), random.Random(6)
    pitch = side // count
    tints = [[mix((0.74, 0.70, 0.64), (0.60, 0.57, 0.55), generator.random()) if (i + j) % 2
              else mix((0.34, 0.36, 0.42), (0.25, 0.27, 0.33), generator.random())
              for i in range(count)] for j in range(count)]

    def color(x, y):
        i, j = x // pitch, y // pitch
        edge = min(x % pitch, y % pitch, pitch - 1 - x % pitch, pitch - 1 - y % pitch)
        # Each tile has its own cut of the stone, so that the picture repeats without a seam.
        vein = noise.fractal(x / 60 + 31 * i, y / 60 + 47 * j, 7.0 * (i + count * j), 4)
        line = math.exp(-((vein - 0.5) / 0.018) ** 2)
        stone = tuple(c * (0.90 + 0.20 * vein) + 0.07 * line for c in tints[j][i])
        return mix((0.16, 0.15, 0.15), stone, smooth(0.5, 2.5, edge))

    write_png(path, side, side, (bytes(to_byte(value) for x in range(side) for value in color(x, y))
                                 for y in range(side)))


GLYPHS = {  # 5 x 7, a row a number, the leftmost column is the highest bit
    "A": (14, 17, 17, 31, 17, 17, 17), "B": (30, 17, 17, 30, 17, 17, 30),
    "C": (14, 17, 16, 16, 16, 17, 14), "D": (30, 17, 17, 17, 17, 17, 30),
    "E": (31, 16, 16, 30, 16, 16, 31), "F": (31, 16, 16, 30, 16, 16, 16),
    "G": (14, 17, 16, 23, 17, 17, 14), "H": (17, 17, 17, 31, 17, 17, 17),
    "1": (4, 12, 4, 4, 4, 4, 14), "2": (14, 17, 1, 6, 8, 16, 31),
    "3": (30, 1, 1, 14, 1, 1, 30), "4": (2, 6, 10, 18, 31, 2, 2),
    "5": (31, 16, 30, 1, 1, 17, 14), "6": (14, 16, 30, 17, 17, 17, 14),
}


def letters(path):
    columns, rows, pitch, dot = 8, 6, 96, 7
    width, height = columns * pitch, rows * pitch

    def hue(share):
        return tuple(0.5 + 0.5 * math.cos(2 * math.pi * (share - shift)) for shift in (0, 1 / 3, 2 / 3))

    def color(x, y):
        i, j = x // pitch, y // pitch
        inside_x, inside_y = x % pitch, y % pitch
        if min(inside_x, inside_y) < 2 or max(inside_x, inside_y) >= pitch - 2:
            return (0.10, 0.10, 0.12)
        paper = mix(hue(i / columns), (0.96, 0.95, 0.92), 0.30 + 0.42 * ((i + j) % 2))
        paper = mix(paper, (0.10, 0.10, 0.15), 0.07 * j)
        left, top = (inside_x - 10) // dot, (inside_y - 23) // dot
        glyph = "ABCDEFGH"[i] if left < 5 else "123456"[j]
        bit = left if left < 5 else left - 6
        on = 0 <= top < 7 and 0 <= bit < 5 and GLYPHS[glyph][top] >> (4 - bit) & 1
        return (0.07, 0.07, 0.10) if on else paper

    write_png(path, width, height, (bytes(to_byte(value) for x in range(width) for value in color(x, y))
                                    for y in range(height)))


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "scenes" / "textures"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    for make in (stars, dusk, tiles, letters):
        make(folder / f"{make.__name__}.png")


if __name__ == "__main__":
    main()
