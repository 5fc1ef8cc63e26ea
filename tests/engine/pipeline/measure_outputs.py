#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the files of `toile make` with readers that share nothing with their writers.

  measure_outputs.py FOLDER

Prints as JSON by how much (mm) the lines of pattern.dxf (ezdxf), pattern.svg, pattern.plt and of
one.svg, which poppler made of the pattern on one PDF page, differ from lengths.csv at most, and how
many were compared.
"""
import csv
import json
import math
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

import ezdxf

SVG = "{http://www.w3.org/2000/svg}"


def polyline_length(points, closed=False):
    ends = points[1:] + points[:1] if closed else points[1:]
    return sum(math.dist(a, b) for a, b in zip(points, ends))


def read_contract(folder):
    with open(folder / "lengths.csv", encoding="utf-8", newline="") as file:
        head = file.readline()
        assert re.search(r"inputs [0-9a-f]{32}$", head.strip()), head
        return list(csv.DictReader(file))


def measure_dxf(folder, contract):
    """Each edge of seams.json along the vertices of its piece's sew line."""
    seams = json.loads((folder / "seams.json").read_text(encoding="utf-8"))
    blocks = {piece["id"]: piece["block"] for piece in seams["pieces"]}
    wanted = {line["edge"]: float(line["pattern"]) for line in contract if line["edge"]}
    document = ezdxf.readfile(folder / "pattern.dxf")
    worst = 0
    count = 0
    for edge in seams["edges"]:
        lines = [e for e in document.blocks[blocks[edge["piece"]]] if e.dxftype() == "POLYLINE"]
        sewn = [e for e in lines if e.dxf.layer == "14"] or \
               [e for e in lines if e.dxf.layer in ("1", "11")]
        best = None
        for line in sewn:
            loop = [(v.dxf.location.x, v.dxf.location.y) for v in line.vertices]
            place = {}
            for index, vertex in enumerate(loop):
                place[(round(vertex[0], 3), round(vertex[1], 3))] = index
            at = [place.get((p[0], p[1])) for p in edge["points"]]
            if None in at:
                continue
            # Which way round: mates run against each other.
            size = len(loop)
            first = (at[1] - at[0]) % size
            step = 1 if first <= size / 2 else -1
            length = 0
            index = at[0]
            turns = 0
            for goal in at[1:]:
                while index != goal and turns <= size:
                    after = (index + step) % size
                    length += math.dist(loop[index], loop[after])
                    index = after
                    turns += 1
            best = length
        assert best is not None, f"edge {edge['code']} is not on its sew line"
        worst = max(worst, abs(best - wanted[edge["code"]]))
        count += 1
    return worst, count


def path_length(way):
    """Length of a path of M, L, A and Z, absolute."""
    tokens = re.findall(r"[MLAZ]|-?[0-9.]+", way)
    length = 0
    at = start = None
    command = None
    index = 0

    def take(n):
        nonlocal index
        values = [float(t) for t in tokens[index:index + n]]
        index += n
        return values

    while index < len(tokens):
        if tokens[index].isalpha():
            command = tokens[index]
            index += 1
            if command == "Z":
                length += math.dist(at, start)
                at = start
                continue
        if command == "M":
            at = start = tuple(take(2))
            command = "L"
        elif command == "L":
            to = tuple(take(2))
            length += math.dist(at, to)
            at = to
        elif command == "A":
            radius, _, _, large, _, x, y = take(7)
            assert large == 0
            chord = math.dist(at, (x, y))
            length += 2 * radius * math.asin(min(1.0, chord / (2 * radius)))
            at = (x, y)
    return length


def measure_svg(folder, contract):
    wanted = {}
    for line in contract:
        if line["edge"]:
            wanted[line["edge"]] = float(line["pattern"])
    found = {}
    for path in ElementTree.parse(folder / "pattern.svg").iter(SVG + "path"):
        edge = path.get("data-edge")
        if edge:
            code = edge.split("-")[0]
            found[code] = found.get(code, 0) + path_length(path.get("d"))
    assert set(found) == set(wanted), set(found) ^ set(wanted)
    return max(abs(found[code] - wanted[code]) for code in wanted), len(wanted)


def piece_perimeters(contract):
    """Of the pieces without allowance and holes the cut line is the sew line."""
    sums = {}
    for line in contract:
        if line["kind"] not in ("feature", "elastic", "mark"):
            sums[line["piece"]] = sums.get(line["piece"], 0) + float(line["pattern"])
    return sums


def measure_hpgl(folder, contract):
    text = (folder / "pattern.plt").read_text(encoding="ascii")
    assert text.startswith("IN;") and all(len(line) <= 201 for line in text.splitlines())
    lengths = []
    pen = None
    way = []
    for command in text.replace("\n", "").split(";"):
        numbers = [int(n) for n in re.findall(r"-?\d+", command[2:])]
        if command.startswith(("PU", "SP")) and len(way) > 1 and pen == 2 and way[0] == way[-1]:
            lengths.append(polyline_length(way) / 40)
        if command.startswith("SP"):
            pen = numbers[0]
            way = []
        elif command.startswith("PU"):
            way = [tuple(numbers)] if numbers else []
        elif command.startswith("PD"):
            assert min(numbers) >= 0
            way += list(zip(numbers[::2], numbers[1::2]))
    without_allowance = pieces_without_allowance(folder)
    worst = 0
    for piece, perimeter in piece_perimeters(contract).items():
        if piece in without_allowance:
            worst = max(worst, min(abs(length - perimeter) for length in lengths))
    return worst, len(without_allowance), len(lengths)


def measure_pdf(folder, contract):
    """Closed lines of the cut line's width, in points."""
    lengths = []
    for path in ElementTree.parse(folder / "one.svg").iter(SVG + "path"):
        style = path.get("style") or ""
        width = path.get("stroke-width") or (re.findall(r"stroke-width:([0-9.]+)", style) + ["0"])[0]
        way = path.get("d") or ""
        if abs(float(width) - 0.6 * 72 / 25.4) < 0.01 and "Z" in way:
            lengths.append(path_length(way[:way.index("Z") + 1]) * 25.4 / 72)
    without_allowance = pieces_without_allowance(folder)
    return max(min(abs(length - perimeter) for length in lengths)
               for piece, perimeter in piece_perimeters(contract).items()
               if piece in without_allowance)


def pieces_without_allowance(folder):
    without_allowance = set()
    seams = json.loads((folder / "seams.json").read_text(encoding="utf-8"))
    svg = ElementTree.parse(folder / "pattern.svg")
    for group in svg.iter(SVG + "g"):
        piece = group.get("data-piece")
        sewn = [p for p in group.iter(SVG + "path")
                if p.get("data-kind") in ("seam", "opening", "border", "dart")]
        if piece and sewn and all(p.get("stroke") == "none" for p in sewn):
            without_allowance.add(piece)
    assert {p["id"] for p in seams["pieces"]} >= without_allowance
    return without_allowance


def main(folder):
    contract = read_contract(folder)
    dxf, edges = measure_dxf(folder, contract)
    svg, paths = measure_svg(folder, contract)
    hpgl, outlines, cuts = measure_hpgl(folder, contract)
    kept = [abs(float(line["pattern"]) - float(line["target"]))
            for line in contract if line["rule"] == "keep"]
    mates = [abs(float(line["difference"])) for line in contract if line["mate"]]
    json.dump({"dxf": dxf, "edges": edges, "svg": svg, "paths": paths, "hpgl": hpgl,
               "pdf": measure_pdf(folder, contract), "outlines": outlines, "cuts": cuts, "lines": len(contract),
               "kept": max(kept), "mates": max(mates),
               "perimeters": piece_perimeters(contract)}, sys.stdout)


main(pathlib.Path(sys.argv[1]))
