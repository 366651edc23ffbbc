"""Builds and installs the Python package: pip install --no-build-isolation . (docs/python.md)."""

import re
import sys
from pathlib import Path

from skbuild import setup

version = re.search(r"project\(hemitex VERSION ([\d.]+)", Path(__file__).with_name("CMakeLists.txt").read_text())
assert version

setup(
    name="hemitex",
    version=version.group(1),
    description="Light of 3D scenes by radiosity, with known accuracy",
    packages=["hemitex"],
    package_dir={"": "python"},
    package_data={"hemitex": ["py.typed", "_core.pyi"]},
    python_requires=">=3.9",
    install_requires=["numpy", "scipy"],
    extras_require={"xarray": ["xarray"], "notebooks": ["matplotlib", "nbconvert", "ipykernel", "xarray"]},
    cmake_install_dir="python/hemitex",
    cmake_install_target="install_python",
    cmake_args=[
        "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O2", "-DHEMITEX_PYTHON=ON",
        "-DHEMITEX_PYTHON_FOLDER=.", "-DHEMITEX_TESTS=OFF", "-DHEMITEX_INSTALL=OFF",
        f"-DPython_EXECUTABLE={sys.executable}"
    ],
)
