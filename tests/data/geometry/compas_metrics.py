"""Metrics of great_court_300.json by COMPAS 2.15.1 (pip install compas==2.15.1), for tests/geometry_compas.rs."""
import json
import math
import pathlib

from compas.datastructures import Mesh

here = pathlib.Path(__file__).parent
data = json.loads((here / "great_court_300.json").read_text())
mesh = Mesh.from_vertices_and_faces(data["vertices"], data["faces"])
faces = sorted(mesh.faces())
lengths = [mesh.edge_length(edge) for edge in mesh.edges()]
mean = math.fsum(lengths) / len(lengths)


def average(values):
    return math.fsum(values) / len(values)


curvature = [mesh.face_curvature(f) for f in faces]
skewness = [mesh.face_skewness(f) for f in faces]
out = {
    "compas": "2.15.1",
    "edges": len(lengths),
    "curvature": curvature,
    "skewness": skewness,
    "flatness": [mesh.face_flatness(f, maxdev=1.0) for f in faces],
    "area": [mesh.face_area(f) for f in faces],
    "mean_curvature": average(curvature),
    "mean_skewness": average(skewness),
    "mean_aspect_ratio": average([mesh.face_aspect_ratio(f) for f in faces]),
    "edge_spread": math.sqrt(average([(l - mean) ** 2 for l in lengths])),
}
(here / "great_court_300_compas.json").write_text(json.dumps(out) + "\n")
