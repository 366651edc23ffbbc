"""The notebooks run, hold no outputs, and draw pictures."""

import base64
import io
from pathlib import Path

import nbformat
import numpy as np
import pytest
from conftest import TOP
from matplotlib import image
from nbconvert.preprocessors import ExecutePreprocessor

#: The number of pictures of each notebook.
PICTURES = {
    "1-hemicube": 3,
    "2-from-row-to-picture": 3,
    "3-error-and-resolution": 1,
    "4-rasterizer": 1,
    "5-furnace-and-street": 2
}


def test_all_notebooks_are_tested() -> None:
    assert {path.stem for path in (TOP / "python/notebooks").glob("*.ipynb")} == set(PICTURES)


@pytest.mark.parametrize("name", PICTURES)
def test_notebook_runs_and_draws_its_pictures(name: str, tmp_path: Path) -> None:
    path = TOP / "python/notebooks" / f"{name}.ipynb"
    notebook = nbformat.read(path, as_version=4)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(not cell.outputs and cell.execution_count is None for cell in cells)
    ExecutePreprocessor(timeout=120).preprocess(notebook, {"metadata": {"path": str(path.parent)}})
    outputs = [output for cell in cells for output in cell.outputs]
    assert not [output for output in outputs if output.get("name") == "stderr"]
    pictures = [output.data["image/png"] for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) == PICTURES[name]
    for picture in pictures:
        pixels = image.imread(io.BytesIO(base64.b64decode(picture)))[..., :3]
        assert min(pixels.shape[:2]) > 200
        assert len(np.unique((pixels * 255).astype(int).reshape(-1, 3), axis=0)) > 50  # not empty
