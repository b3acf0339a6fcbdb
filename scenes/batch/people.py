#!/usr/bin/env python3
"""The people of `people-10000.toml`, and the hashes of its heads.

    frisure presets --json | python3 scenes/batch/people.py table > scenes/batch/people.csv
    python3 scenes/batch/people.py hashes FOLDER 50 > scenes/batch/people-10000.hashes.csv
    python3 scenes/batch/people.py check FOLDER

`hashes` and `check` need the Python package frisure with pyarrow. `docs/training-data.md` describes the numbers.
"""

import csv
import hashlib
import json
import math
import pathlib
import random
import sys

PEOPLE_PER_TYPE = 40
"""Rows of the table for each hair type. Chosen: enough that few heads have one person."""

DIAMETER = 0.13
"""Relative deviation of the mean diameter between people: 12 to 14 %, docs/hair-types.md."""

AXIS_RATIO = 0.10
"""Deviation of the mean axis ratio between people of one hair type. Chosen: half of that between hairs."""

CURL = 0.25
"""Relative deviation of curl radius and pitch between people of one hair type. Chosen."""

LENGTHS = {1: (5, 60), 2: (4, 50), 3: (4, 45), 4: (3, 35), 5: (2, 25)}
"""Shortest and longest hair (cm, along the fibre) by how tight the curl is. Chosen by eye."""

DARK = {"black": 6, "jet-black": 2, "dark-brown": 2, "salt-and-pepper": 1, "grey": 1}
MIXED = {
    "black": 2, "dark-brown": 4, "brown": 4, "light-brown": 3, "dark-blond": 3, "blond": 2, "light-blond": 1, "auburn": 1,
    "red": 1, "copper": 1, "salt-and-pepper": 1, "grey": 1,
}  # fmt: skip
FAIR = {name: weight for name, weight in MIXED.items() if name != "black"}
"""Natural colours and how often each is drawn. Chosen by eye; no count of people is behind them."""



def tightness(radius: float) -> int:
    """How tight a curl of this radius (m) is: 1 straight to 5 kinky."""
    return 1 + sum(radius < limit for limit in (0.06, 0.02, 0.008, 0.0035))


def colours(name: str) -> dict[str, int]:
    if name.startswith(("asian", "african")):
        return DARK
    return FAIR if name.startswith("caucasian") else MIXED


def models(name: str) -> list[str]:
    if name.startswith("asian"):
        return ["asian-man"]
    if name.startswith("african"):
        return ["african-woman"]
    if name.startswith("caucasian"):
        return ["european-woman", "older-man"]
    return ["african-woman", "asian-man", "european-woman", "older-man"]


def table(presets: list[dict]) -> list[dict]:
    draws = random.Random(1)
    people = []
    for preset in presets:
        name, curl = preset["name"], preset["curl"]
        shortest, longest = LENGTHS[tightness(curl["radius"])]
        weights = colours(name)
        for _ in range(PEOPLE_PER_TYPE):
            scale = math.exp(draws.gauss(0, CURL))
            ratio = preset["axis_ratio"] + draws.gauss(0, AXIS_RATIO)
            people.append({
                "type": name,
                "length (cm)": f"{math.exp(draws.uniform(math.log(shortest), math.log(longest))):.1f}",
                "diameter (um)": f"{1e6 * preset['diameter'] * math.exp(draws.gauss(0, DIAMETER)):.1f}",
                "axis_ratio": f"{max(ratio, 1.05):.2f}",
                "curl radius (mm)": f"{1e3 * curl['radius'] * scale:.2f}",
                "curl pitch (mm)": f"{1e3 * curl['pitch'] * scale:.2f}",
                "colour": draws.choices(list(weights), list(weights.values()))[0],
                "head": draws.choice(models(name)),
                # Each has a face of its own; 0 would be that of the model.
                "face": len(people) + 1,
            })  # fmt: skip
    return people


def summary(head: dict) -> dict:
    """The numbers of a head: the hash of the bytes of its guides, and some that tell how far others are apart."""
    guides = head["guides"]
    return {
        "index": head["index"],
        "sha256": hashlib.sha256(guides.astype("<f4").tobytes()).hexdigest(),
        "guide_count": len(guides),
        "length": f"{head['length']:.6f}",
        "drop": f"{head['drop']:.6f}",
        "tip_height": f"{float(guides[:, -1, 2].mean()):.6f}",
    }


def summaries(folder: str) -> list[dict]:
    from frisure import data

    return [summary(head) for head in data.heads(folder, ["guides", "length", "drop"])]


def check(folder: str, tolerance: float = 1e-4) -> list[str]:
    """What is not as in the list of hashes: other bytes are told, other numbers (m) are faults."""
    path = pathlib.Path(__file__).with_name("people-10000.hashes.csv")
    known = {int(row["index"]): row for row in csv.DictReader(path.open())}
    faults, same, compared = [], 0, 0
    for found in summaries(folder):
        if found["index"] not in known:
            continue
        row = known[found["index"]]
        compared += 1
        same += row["sha256"] == found["sha256"]
        for name in ("guide_count", "length", "drop", "tip_height"):
            if abs(float(row[name]) - float(found[name])) > tolerance:
                faults.append(f"head {found['index']}: {name} is {found[name]}, not {row[name]}")
    print(f"{compared} heads compared: {same} with the same bytes, {len(faults)} faults", file=sys.stderr)
    return faults if compared else ["no head of the list is there"]


def main(arguments: list[str]) -> int:
    match arguments:
        case ["table"]:
            rows = table(json.load(sys.stdin))
        case ["hashes", folder, count]:
            rows = summaries(folder)[: int(count)]
        case ["check", folder]:
            faults = check(folder)
            print("\n".join(faults))
            return 1 if faults else 0
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    writer = csv.DictWriter(sys.stdout, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
