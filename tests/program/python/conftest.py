"""Fixtures that the tests share."""

import pathlib
import subprocess

import pytest

import lobelia

ROOT = pathlib.Path(__file__).resolve().parents[3]

pytest_plugins = ["pytester", "lobelia.pytest_plugin"]


@pytest.fixture(scope="session")
def scene():
    return lobelia.scenes()["oblique_45"]


@pytest.fixture(scope="session")
def image(scene):
    return lobelia.render(scene, width=96, height=96)


@pytest.fixture
def small_scene(scene, tmp_path):
    file = tmp_path / "small.xml"
    file.write_text(lobelia.scene_xml(scene, width=24, height=24))
    return file


@pytest.fixture
def command():
    """Runs the program; returns its exit code, stdout, and stderr without "lobelia: "."""
    import os

    def run(*words):
        done = subprocess.run(
            [os.environ["LOBELIA_PROGRAM"], *map(str, words)], capture_output=True, text=True
        )
        return done.returncode, done.stdout, done.stderr.replace("lobelia: ", "").strip()

    return run
