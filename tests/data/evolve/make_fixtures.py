"""Makes fixtures.json and spread.json with pymoo 0.6 (pip install "pymoo>=0.6,<0.7"):

    python3 make_fixtures.py

fixtures.json: fronts, crowding distances and exact hypervolumes of random points with 2 to 7 objectives.
spread.json: hypervolume of pymoo's NSGA-II on ZDT and DTLZ problems, 11 seeds each (population 100, SBX eta 15
with probability 0.9, polynomial mutation eta 20, 200 generations).
"""

import json

import numpy as np
import pymoo
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.indicators.hv import HV
from pymoo.operators.crossover.sbx import SBX
from pymoo.operators.mutation.pm import PM
from pymoo.operators.survival.rank_and_crowding.metrics import calc_crowding_distance
from pymoo.optimize import minimize
from pymoo.problems import get_problem
from pymoo.util.nds.non_dominated_sorting import NonDominatedSorting


def fixtures():
    rng = np.random.default_rng(20261122)
    cases = []
    for objectives in range(2, 8):
        for kind in ("cloud", "grid", "simplex"):
            points = rng.random((24, objectives))
            if kind == "grid":  # many equal coordinates
                points = np.floor(points * 4) / 4
            if kind == "simplex":  # mutually non-dominated
                points = -np.log(points)
                points = points / points.sum(axis=1, keepdims=True)
            points = np.round(points, 6)
            fronts = [sorted(int(i) for i in f) for f in NonDominatedSorting().do(points)]
            # pymoo gives the mean over the objectives, Deb et al. the sum.
            crowding = [
                (calc_crowding_distance(points[f]) * objectives).tolist() if kind != "grid" else None for f in fronts
            ]
            crowding = [c and [None if np.isinf(x) else x for x in c] for c in crowding]
            volume = float(HV(ref_point=np.ones(objectives))(points))
            cases.append(dict(kind=kind, objectives=objectives, points=points.tolist(), fronts=fronts,
                              crowding=crowding, hypervolume=volume))
    return dict(pymoo=pymoo.__version__, cases=cases)


PROBLEMS = {
    "zdt1": (dict(), [1.1, 1.1]),
    "zdt2": (dict(), [1.1, 1.1]),
    "zdt3": (dict(), [1.1, 1.1]),
    "zdt6": (dict(), [1.1, 1.1]),
    "dtlz2": (dict(n_var=12, n_obj=3), [1.1, 1.1, 1.1]),
    "dtlz5": (dict(n_var=12, n_obj=3), [1.1, 1.1, 1.1]),
}


def spread():
    rows = []
    for name, (options, reference) in PROBLEMS.items():
        problem = get_problem(name, **options)
        values = []
        for seed in range(1, 12):
            algorithm = NSGA2(pop_size=100, crossover=SBX(eta=15, prob=0.9), mutation=PM(eta=20))
            result = minimize(problem, algorithm, ("n_gen", 200), seed=seed)
            values.append(float(HV(ref_point=np.array(reference))(result.F)))
        rows.append(dict(problem=name, variables=problem.n_var, reference=reference, hypervolume=values))
        print(name, min(values), max(values))
    return dict(pymoo=pymoo.__version__, population=100, generations=200, rows=rows)


if __name__ == "__main__":
    json.dump(fixtures(), open("fixtures.json", "w"), separators=(",", ":"))
    json.dump(spread(), open("spread.json", "w"), indent=1)
