"""The command's studies, as arrays. `check.sh` names the command by SELVEDGE_COMMAND."""

import json
import os
import sys
from pathlib import Path

import numpy as np
import pytest

import selvedge
from selvedge import laboratory
from selvedge.errors import CommandError, InputError

from conftest import two_sheets


def columns_agree(table: laboratory.Table) -> int:
    lengths = {len(column) for column in table.values()}
    assert len(lengths) == 1, {name: len(column) for name, column in table.items()}
    return lengths.pop()


def test_every_method_runs_on_a_step_of_ones_own() -> None:
    faces, start = two_sheets(8)
    end = start.copy()
    end[64:, 2] -= 0.2
    tables = laboratory.compare((faces, start, end), rounds=1)
    methods = tables["methods"]
    assert {"naive", "lv_2014", "selvedge", "selvedge_exact"} <= set(methods["pipeline"])
    assert columns_agree(methods) == 11
    contacts = methods["vertex_face_contacts"] + methods["edge_edge_contacts"]
    exact = contacts[methods["pipeline"] == "selvedge_exact"]
    detector = selvedge.Detector(faces, len(start))
    detector.set_limits(touching=True)
    assert exact == len(detector.contacts(start, end)) > 0
    assert methods["missed"][methods["pipeline"] == "selvedge"] == 0
    # The paper has no row for our method.
    paper = dict(zip(methods["pipeline"], methods["paper_frames_per_second"], strict=True))
    assert paper["lv_2014"] > 0 and np.isnan(paper["selvedge"])
    stages = tables["stages"]
    assert set(stages["pipeline"]) == set(methods["pipeline"])
    assert columns_agree(stages) > 2 * 11
    assert (stages["seconds"] >= 0).all()


def test_only_the_methods_asked_for_run() -> None:
    tables = laboratory.compare(small_step(), pipelines=["selvedge", "lv_2014"], rounds=1)
    assert list(tables["methods"]["pipeline"]) == ["selvedge", "lv_2014"]


def small_step() -> laboratory.Step:
    faces, start = two_sheets(4)
    return faces, start.astype(np.float32), start + [0.0, 0.0, 0.01]


def test_filters_are_measured_in_both_formats() -> None:
    tables = laboratory.accuracy(only="filters", pairs=500, repeat=1)
    assert set(tables) == {"filters", "filter_sets"}
    filters = tables["filters"]
    assert columns_agree(filters) > 50
    assert set(filters["scalar"]) == {"f32", "f64"}
    certified = filters["certified"]
    # A filter that proves another statement has no false culls.
    assert np.nansum(filters["false_culls"][certified]) == 0
    assert filters["nanoseconds_per_pair"].min() > 0


def test_elementary_tests_are_measured_on_a_step_of_ones_own_too() -> None:
    tables = laboratory.accuracy(small_step(), only="elementary", pairs=20, repeat=1)
    assert set(tables) == {"elementary", "elementary_sets"}
    elementary = tables["elementary"]
    assert "start to end" in set(elementary["set"])
    assert elementary["false_negatives"][elementary["certified"]].sum() == 0


def test_hard_cases_have_a_row_for_each_case_and_method() -> None:
    table = laboratory.hard_cases("apex on apex")
    assert columns_agree(table) % len(set(table["method"])) == 0
    assert set(table["answer"]) <= {"right", "false-alarm", "missed"}
    assert "missed" not in table["answer"][table["method"] == "exact"]
    assert (table["not_before"] <= table["not_after"]).all()
    single = laboratory.hard_cases("apex on apex", scalar="f32")
    assert len(single["case"]) < len(table["case"])


def test_what_the_command_refuses_is_told_in_its_words() -> None:
    with pytest.raises(InputError, match="no hard case has `nonsense` in its name"):
        laboratory.hard_cases("nonsense")
    with pytest.raises(InputError, match="lv_2013"):
        laboratory.compare(small_step(), pipelines=["lv_2013"])
    with pytest.raises(InputError, match="--help"):
        laboratory.hard_cases("--help")
    with pytest.raises(InputError, match="pairs"):
        laboratory.accuracy(pairs=0)
    with pytest.raises(InputError, match="separation"):
        laboratory.accuracy(separation=-1.0)


def test_a_step_that_is_none_is_refused_before_the_command_runs() -> None:
    faces, start, end = small_step()
    with pytest.raises(InputError, match="three arrays"):
        laboratory.compare((faces, start))  # type: ignore[arg-type]
    with pytest.raises(InputError, match="start"):
        laboratory.compare((faces, [[1.0, 2.0]], end))
    with pytest.raises(InputError, match="3 is negative|is negative"):
        laboratory.compare(([[0, 1, -3]], start, end))
    with pytest.raises(InputError, match="finite|nan|NaN"):
        laboratory.compare((faces, start, np.full_like(np.asarray(end), np.nan)))


def test_a_command_that_is_missing_or_another_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("SELVEDGE_COMMAND", str(tmp_path / "nowhere"))
    with pytest.raises(CommandError, match="nowhere: cannot be run"):
        laboratory.hard_cases()
    monkeypatch.setenv("SELVEDGE_COMMAND", sys.executable)
    with pytest.raises(CommandError, match="Python 3.*this package is"):
        laboratory.hard_cases()
    monkeypatch.delenv("SELVEDGE_COMMAND")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(laboratory.sysconfig, "get_path", lambda _: os.fspath(tmp_path))
    with pytest.raises(CommandError, match="pip install selvedge-command"):
        laboratory.hard_cases()


def test_the_notebooks_cells_run_from_top_to_bottom() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    notebook = json.loads(Path(__file__).with_name("..").joinpath("examples", "accuracy.ipynb").read_text("utf-8"))
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    few = cells[0].replace("5_000", "200")
    assert few != cells[0]
    names: dict[str, object] = {}
    for cell in [few, *cells[1:]]:
        exec(compile(cell, "accuracy.ipynb", "exec"), names)
    assert len(matplotlib.pyplot.get_fignums()) == len(cells) - 1
    matplotlib.pyplot.close("all")
