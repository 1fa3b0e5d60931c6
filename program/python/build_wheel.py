"""Makes a wheel from a CMake build: the backend of pyproject.toml.

pip wheel ./program/python                                            builds the preset release first
pip wheel ./program/python --config-settings build=$PWD/build/ci      takes a build as it is
"""

import base64
import hashlib
import pathlib
import re
import subprocess
import sysconfig
import zipfile

PYTHON = pathlib.Path(__file__).resolve().parent
ROOT = PYTHON.parent.parent
PRESET = "release"
TARGETS = ["lobelia_python", "lobelia_image_io"]
COMPANIONS = ["lobelia_*.so", "lobelia_picture_reader", "lobelia_process_keeper", "engine_*"]


def version() -> str:
    found = re.search(r"project\(lobelia VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert found
    return found[1]


def built() -> pathlib.Path:
    """The preset's build, up to date."""
    subprocess.run(["cmake", "--preset", PRESET, "-DLOBELIA_PYTHON=ON"], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", "--preset", PRESET, "--target", *TARGETS], cwd=ROOT, check=True)
    return ROOT / "build" / PRESET


def contents(build: pathlib.Path) -> dict[str, pathlib.Path]:
    """Files by their names in the wheel."""
    module = build / "bin" / f"_lobelia.{sysconfig.get_config_var('SOABI')}.so"
    if not module.exists():
        raise SystemExit(f"{module}: there is no such file; build the target lobelia_python")
    companions = [file for name in COMPANIONS for file in sorted((build / "bin").glob(name))]
    package = sorted(file for file in (PYTHON / "lobelia").iterdir() if file.is_file())
    files = {f"lobelia/{file.name}": file for file in [*package, module, *companions]}
    for scene in sorted((ROOT / "reference_scenes/scenes").glob("*.xml")):
        files[f"lobelia/scenes/{scene.name}"] = scene
    return files


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None) -> str:
    given = (config_settings or {}).get("build")
    build = pathlib.Path(given) if given else built()
    python = f"cp{sysconfig.get_config_var('py_version_nodot')}"
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    info = f"lobelia-{version()}.dist-info"
    metadata = (PYTHON / "METADATA.in").read_text().replace("@PROJECT_VERSION@", version())
    texts = {
        f"{info}/METADATA": metadata,
        f"{info}/entry_points.txt": (PYTHON / "entry_points.txt").read_text(),
        f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: lobelia\nRoot-Is-Purelib: false\nTag: {tag}\n",
    }
    name = f"lobelia-{version()}-{tag}.whl"
    record = ""
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:

        def add(place: str, data: bytes, mode: int) -> None:
            nonlocal record
            entry = zipfile.ZipInfo(place)  # dated 1980: the same build gives the same wheel
            entry.external_attr = mode << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{place},sha256={digest},{len(data)}\n"

        for place, file in contents(build).items():
            add(place, file.read_bytes(), 0o100755 if file.stat().st_mode & 0o100 else 0o100644)
        for place, text in texts.items():
            add(place, text.encode(), 0o100644)
        record += f"{info}/RECORD,,\n"
        wheel.writestr(f"{info}/RECORD", record)
    return name
