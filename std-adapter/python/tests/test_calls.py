"""Calls with threads, processes and signals."""

import _thread
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager

import numpy as np
import pytest
from conftest import sheet, two_sheets

from selvedge import ARM_SLEEVE, Detector, Simulation, errors


FACES, FLAT = sheet(300)


@pytest.fixture(autouse=True)
def ctrl_c_is_heard():
    """Makes Ctrl-C work: background jobs of a shell, and processes started by nohup, ignore it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def long_question(threads: int = 1):
    """A question that takes many seconds: all parts of a crumpled sheet are near each other."""
    detector, random = Detector(FACES, len(FLAT), threads), np.random.default_rng(0)
    assert detector.is_free(FLAT, FLAT + 1.0)
    return detector, random.uniform(0, 1, FLAT.shape), random.uniform(0, 1, FLAT.shape)


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_ends_a_long_call_and_leaves_the_detector_usable(threads):
    detector, start, end = long_question(threads)
    threading.Timer(0.3, _thread.interrupt_main).start()
    # Otherwise the call would run until memory ends.
    otherwise = threading.Timer(60, detector.cancel)
    otherwise.start()
    with pytest.raises(KeyboardInterrupt):
        detector.contacts(start, end)
    otherwise.cancel()
    assert detector.is_free(FLAT, FLAT + 1.0)


@contextmanager
def asked_in_another_thread(detector: Detector, start: np.ndarray, end: np.ndarray):
    """Asks a long question in another thread; the caller has to cancel it."""
    ended: list[object] = []

    def ask() -> None:
        try:
            detector.contacts(start, end)
        except errors.CancelledError as error:
            ended.append(error)

    thread = threading.Thread(target=ask)
    thread.start()
    time.sleep(0.3)
    assert thread.is_alive()
    try:
        yield
    finally:
        detector.cancel()
        thread.join()
    assert len(ended) == 1


def test_cancel_ends_what_another_thread_asks():
    detector, start, end = long_question()
    with asked_in_another_thread(detector, start, end):
        pass
    assert detector.is_free(FLAT, FLAT + 1.0)


def test_the_interpreter_is_free_meanwhile_and_a_second_thread_is_refused():
    detector, start, end = long_question()
    with asked_in_another_thread(detector, start, end):
        with pytest.raises(errors.BusyError, match="another thread"):
            detector.is_free(start, end)
        with pytest.raises(errors.BusyError):
            detector.set_limits(0.1)


def test_cancelling_nothing_does_nothing():
    faces, start = two_sheets(4)
    detector = Detector(faces, len(start))
    detector.cancel()
    assert detector.is_free(start, start)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_a_forked_child_gets_an_error_and_not_a_hang():
    faces, start = two_sheets(20)
    many, one = Detector(faces, len(start), 2), Detector(faces, len(start))
    assert many.is_free(start, start)
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        code = 1
        try:
            many.is_free(start, start)
        except errors.ForkedError:
            code = 0 if one.is_free(start, start) else 2
        finally:
            os._exit(code)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert many.is_free(start, start)


def is_free(detector: Detector, start: np.ndarray) -> bool:
    return detector.is_free(start, start)


def test_detectors_go_to_other_processes():
    faces, start = two_sheets(10)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply(is_free, (Detector(faces, len(start), 2), start))


def test_ctrl_c_ends_a_simulation_after_a_whole_step():
    simulation = Simulation.from_text(ARM_SLEEVE)
    threading.Timer(0.3, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        simulation.step(1_000_000)
    done = simulation.steps_done
    assert 0 < done < 1_000_000
    again = Simulation.from_text(ARM_SLEEVE)
    again.step(done + 1)
    simulation.step()
    np.testing.assert_array_equal(simulation.positions, again.positions)


def test_it_is_imported_without_a_warning():
    done = subprocess.run([sys.executable, "-W", "error", "-c", "import selvedge, selvedge.ipc"], capture_output=True, text=True)
    assert done.returncode == 0 and done.stderr == ""
