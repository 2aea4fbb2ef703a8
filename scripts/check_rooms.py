#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails on any include between rooms of engine/ that engine/ROOMS does not list."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'^\s*#\s*include\s*"([a-z_]+)/[^"]+"')


def read_rooms(text):
    """{room: rooms it may include}, itself among them."""
    rooms = {}
    for line in text.splitlines():
        line = line.split("#")[0].strip()
        if line:
            room, allowed = line.split(":")
            rooms[room.strip()] = {room.strip(), *allowed.split()}
    return rooms


def faults(engine):
    rooms = read_rooms((engine / "ROOMS").read_text())
    for folder in sorted(path for path in engine.iterdir() if path.is_dir()):
        if folder.name not in rooms:
            yield f"{folder}: not a room of engine/ROOMS"
            continue
        for source in sorted(folder.rglob("*")):
            if source.suffix not in {".h", ".cpp", ".in"}:
                continue
            for number, line in enumerate(source.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if match and match.group(1) not in rooms[folder.name]:
                    yield f"{source}:{number}: {folder.name} may not include {match.group(1)}"


def main():
    engine = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "engine"
    found = list(faults(engine))
    print("\n".join(found) or "rooms: every include is allowed")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
