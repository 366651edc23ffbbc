"""hemitex computes the light of 3D scenes by radiosity, and says how accurate it is.

The package has the functions of the C++ library under its names, with NumPy arrays in and out:

>>> import hemitex as hx
>>> room = hx.Scene.from_arrays(
...     vertices=[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
...     faces=[[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]],
...     reflectance=0.5, emission=1, names=["floor", "ceiling", "south", "east", "north", "west"])
>>> solution = hx.solve(room, residual=1e-6)
>>> bool(abs(solution.radiosity - 2).max() < 0.01)  # a furnace: emission / (1 - reflectance)
True

Lengths are in the unit of the scene, areas in its square. Radiosity and emission are in W/m^2 per RGB band.
Wrong input raises `InputError`, with the file, the line and an advice. Long calls take `progress`, a function of the
share that is done, and stop on Ctrl-C. Other threads run meanwhile. Results never depend on the number of threads.
"""

from ._core import InputError
from .cameras import Camera, camera
from .conformance import Explanation, TestVector, Verdict, explain, judge, read_vector, vector_suite
from .form_factors import (FormFactorMatrix, FormFactorRow, Hemicube, HemicubeFace, MatrixDifference, MatrixVerdict,
                           analytic, check_matrix, form_factor_matrix, form_factor_row, hemicube, rays, read_matrix)
from .light import Sensitivity, Solution, UpdateCost, edit, insist, sensitivity, solve, threads
from .pictures import render
from .rasterizers import Device, Draw, DrawList, Face, Rasterizer
from .scenes import (Add, Edit, Elements, Move, Remove, Restore, Scene, SetEmission, SetReflectance, discretize,
                     load_scene)

__all__ = [
    "Add", "Camera", "Device", "Draw", "DrawList", "Edit", "Elements", "Explanation", "Face", "FormFactorMatrix",
    "FormFactorRow", "Hemicube", "HemicubeFace", "InputError", "MatrixDifference", "MatrixVerdict", "Move",
    "Rasterizer", "Remove", "Restore", "Scene", "Sensitivity", "SetEmission", "SetReflectance", "Solution",
    "TestVector", "UpdateCost", "Verdict", "analytic", "camera", "check_matrix", "discretize", "edit", "explain",
    "form_factor_matrix", "form_factor_row", "hemicube", "insist", "judge", "load_scene", "rays", "read_matrix",
    "read_vector", "render", "sensitivity", "solve", "threads", "vector_suite"
]
