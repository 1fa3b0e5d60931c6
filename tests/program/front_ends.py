"""Compares pairs as a user of the Python package does. Reads a list of pairs, writes what came of each."""

import json
import sys

import numpy as np

import lobelia


def options_of(pair):
    """The keywords of lobelia.compare()."""
    keywords = {}
    for name, value in pair["options"]:
        name = name.replace("-", "_")
        name = {"fail": "limits", "warn": "warnings"}.get(name, name)
        if name == "no_default_limits":
            keywords["default_limits"] = False
        elif name in ("limits", "warnings", "mask", "ignore", "a_replicate", "b_replicate"):
            keywords.setdefault(name, []).append(value)
        else:
            keywords[name] = True if value == "true" else value
    return keywords


def compared(a, b, keywords):
    try:
        return {"record": json.loads(lobelia.compare(a, b, **keywords).to_json())}
    except lobelia.Error as error:
        return {"error": str(error)}


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        pairs = json.load(file)
    results = []
    for pair in pairs:
        keywords = options_of(pair)
        result = {"files": compared(pair["a"], pair["b"], keywords)}
        if pair["plain"]:
            arrays = [np.asarray(lobelia.read(pair[side])) for side in ("a", "b")]
            result["arrays"] = compared(*arrays, keywords)
        results.append(result)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump(results, file)


main()
