#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a DXF with ezdxf and prints what it holds as JSON: read_dxf.py FILE"""
import json
import sys

import ezdxf


def lines_of(block):
    lines = []
    for entity in block:
        kind = entity.dxftype()
        layer = int(entity.dxf.layer)
        if kind == "POLYLINE":
            points = [[v.dxf.location.x, v.dxf.location.y] for v in entity.vertices]
            lines.append({"kind": kind, "layer": layer, "closed": entity.is_closed, "points": points})
        elif kind == "LINE":
            points = [list(entity.dxf.start)[:2], list(entity.dxf.end)[:2]]
            lines.append({"kind": kind, "layer": layer, "closed": False, "points": points})
        elif kind == "POINT":
            where = entity.dxf.location
            lines.append({"kind": kind, "layer": layer, "points": [[where.x, where.y]], "z": where.z,
                          "angle": entity.dxf.angle})
        elif kind == "TEXT":
            lines.append({"kind": kind, "layer": layer, "points": [list(entity.dxf.insert)[:2]],
                          "text": entity.dxf.text, "height": entity.dxf.height})
        else:
            lines.append({"kind": kind, "layer": layer})
    return lines


def main(path):
    document = ezdxf.readfile(path)
    blocks = {block.name: lines_of(block) for block in document.blocks
              if not block.is_any_layout}
    inserts = [[e.dxf.name, e.dxf.insert.x, e.dxf.insert.y]
               for e in document.modelspace() if e.dxftype() == "INSERT"]
    style = [e.dxf.text for e in document.modelspace() if e.dxftype() == "TEXT"]
    other = [e.dxftype() for e in document.modelspace() if e.dxftype() not in ("INSERT", "TEXT")]
    # The geometry is read before the audit, which may change it. Code 202 is about SEQEND, which
    # this version reports for every R12 file, its own included.
    audit = document.audit()
    faults = [f"{e.code} {e.message}" for e in audit.errors]
    faults += [f"{e.code} {e.message}" for e in audit.fixes if int(e.code) != 202]
    json.dump({"version": document.dxfversion, "blocks": blocks, "inserts": inserts,
               "style": style, "other": other, "faults": faults}, sys.stdout)


main(sys.argv[1])
