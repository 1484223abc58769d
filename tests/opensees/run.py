"""Runs a deck of `quadrille export --format opensees` in OpenSees and compares it with the frame solver.

    python run.py DECK.tcl ANSWER.json

DECK.tcl is read line by line as commands of openseespy (every line of it is one plain command); ANSWER.json is what
`quadrille frame MODEL.json --format json` prints for the model of `export --format frame`. Prints the largest
difference of displacements, reactions and member forces, relative to the largest of each kind.
"""
import json
import sys

import openseespy.opensees as ops


def word(text):
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def run(deck):
    for line in open(deck, encoding="utf-8"):
        words = line.split()
        if not words or words[0].startswith("#") or words[0] in ("}", "recorder"):
            continue
        command, arguments = words[0], [word(w) for w in words[1:] if w != "{"]
        if getattr(ops, command)(*arguments) not in (0, None) and command == "analyze":
            sys.exit("OpenSees did not converge")


def main(deck, answer):
    run(deck)
    ours = json.load(open(answer, encoding="utf-8"))
    ops.reactions()
    pairs = {"displacements": [], "rotations": [], "reactions": [], "axial": [], "moments": []}
    for node in ours["displacements"]:
        theirs = ops.nodeDisp(node["node"] + 1)
        pairs["displacements"] += list(zip(node["u"][:3], theirs[:3]))
        pairs["rotations"] += list(zip(node["u"][3:], theirs[3:]))
    for node in ours["reactions"]:
        theirs = ops.nodeReaction(node["node"] + 1)
        pairs["reactions"] += [(a, b) for a, b in zip(node["r"], theirs) if a is not None]
    for end in ours["member_forces"]:
        # Forces on the member's ends in its own axes: the cut face at the start looks the other way.
        forces = ops.eleResponse(end["member"] + 1, "localForce")
        side, sign = (forces[:6], -1) if end["end"] == "start" else (forces[6:], 1)
        pairs["axial"].append((end["N"], sign * side[0]))
        pairs["moments"] += [(end["Mt"], sign * side[3]), (abs(end["My"]), abs(side[4])), (abs(end["Mz"]), abs(side[5]))]
    for name, values in pairs.items():
        largest = max((abs(a) for a, _ in values), default=0.0)
        difference = max((abs(a - b) for a, b in values), default=0.0)
        print(f"{name}: largest {largest:.6e}, differs by {difference / largest if largest else 0.0:.1e}")


if __name__ == "__main__":
    main(*sys.argv[1:])
