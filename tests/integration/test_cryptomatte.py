"""Cryptomattes written by a plain Blender: masks, radiance and names."""

import json
import subprocess
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest

import mattes
from labels import decode_rle
from pictures import read_grey, read_planes
from program import ROOT, Veldt

WIDTH, HEIGHT = 64, 48
# tree_169 is a name whose hash would be a denormal number: Blender's manifest has it as it was before it was made none.
OBJECTS = {"elephant": 2, "walker.001": 3, "tree_169": 4}
# The quotes make Blender's manifest of materials no JSON: these names are hashed.
MATERIALS = {"Fell Ä": 2, 'Haut "zart"': 3, "Laub": 4}

SCENE = """
import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.samples = 16
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
layer = scene.view_layers[0]
layer.use_pass_object_index = layer.use_pass_z = layer.use_pass_normal = True
layer.use_pass_cryptomatte_object = layer.use_pass_cryptomatte_material = True
layer.pass_cryptomatte_depth = 4
for (name, index), material, place in zip(
    OBJECTS.items(), MATERIALS, [(-0.4, 0, 0), (1, 0.3, 0.6), (0.4, -1, -0.8)]
):
    bpy.ops.mesh.primitive_uv_sphere_add(location=place)
    sphere = bpy.context.object
    sphere.name, sphere.pass_index = name, index
    sphere.data.materials.append(bpy.data.materials.new(material))
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (0, 0, 9)
scene.collection.objects.link(camera)
scene.camera = camera
settings = scene.render.image_settings
if hasattr(settings, "media_type"):  # Blender 5
    settings.media_type = "MULTI_LAYER_IMAGE"
settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
scene.render.filepath = "//000000.exr"
bpy.ops.wm.save_as_mainfile(filepath=FOLDER + "/scene.blend")
bpy.ops.render.render(write_still=True)
"""


def _render(folder: Path, blender: str) -> None:
    names = f"OBJECTS, MATERIALS, FOLDER = {OBJECTS!r}, {MATERIALS!r}, {str(folder)!r}\n"
    names += f"WIDTH, HEIGHT = {WIDTH}, {HEIGHT}\n"
    (folder / "scene.py").write_text(names + SCENE, encoding="utf-8")
    command = [blender, "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "--python"]
    done = subprocess.run(
        [*command, str(folder / "scene.py")], cwd=folder, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def _manifest(cryptomatte: str, names: dict[str, int]) -> dict:
    """Three actors of three materials, identified by the names of a cryptomatte."""
    materials = ("elephant", "human", "zebra")
    return {
        "format": "veldt-passes",
        "version": 1,
        "clip": "spheres",
        "camera": {
            "width_px": WIDTH,
            "height_px": HEIGHT,
            "fx_px": 90,
            "fy_px": 90,
            "cx_px": 32,
            "cy_px": 24,
        },
        "cryptomatte": cryptomatte,
        "objects": [
            {
                "index": index,
                "name": f"actor {index}",
                "mattes": [name],
                "class": "actor",
                "material": material,
                "category": material,
                "track_id": index,
            }
            for (name, index), material in zip(names.items(), materials)
        ],
        "materials": [],
        "frames": [{"file": "000000.exr"}],
    }


@pytest.fixture(scope="module", name="rendered")
def _rendered(tmp_path_factory, blender) -> Veldt:
    """A place with the passes of a plain Blender in the folder passes."""
    veldt = Veldt(tmp_path_factory.mktemp("spheres"))
    (veldt.folder / "passes").mkdir()
    _render(veldt.folder / "passes", blender)
    return veldt


def _convert(veldt: Veldt, manifest: dict, out: str, folder: str = "passes"):
    veldt.write(f"{folder}/manifest.json", manifest)
    ideal = ("sensor.optics.blur_sigma_px=0", "sensor.noise.amount=0")
    done = veldt("convert", folder, "--out", out, "--quiet", "--set", *ideal)
    assert (done.code, done.out, done.err) == (0, "", "")


def _ranks(veldt: Veldt, matte: str, names: dict[str, int]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Index and coverage of each rank, taken apart without the program."""
    planes = read_planes(veldt.folder / "passes" / "000000.exr")
    index_of = {mattes.matte_hash(name): index for name, index in names.items()} | {0: 0}
    ranks = []
    for k in range(4):
        hash_of, cover = ("r", "g") if k % 2 == 0 else ("b", "a")
        bits = np.ascontiguousarray(planes[f"ViewLayer.{matte}{k // 2:02}.{hash_of}"]).view(np.uint32)
        assert set(np.unique(bits)) <= set(index_of)
        index = np.vectorize(index_of.get)(bits)
        ranks.append((index, planes[f"ViewLayer.{matte}{k // 2:02}.{cover}"].astype(float)))
    return ranks


def _expected_index(ranks) -> np.ndarray:
    """The index with the largest coverage, or sky. Blender 3.4's rank 0 is not always the largest."""
    index = np.stack([each for each, _ in ranks])
    shares = np.where(index > 0, np.stack([coverage for _, coverage in ranks]), 0)
    most = shares.argmax(axis=0)[None]  # the first of several
    left = 1 - shares.sum(axis=0)
    return np.where(left > shares.max(axis=0), 0, np.take_along_axis(index, most, axis=0)[0])


def _check_masks(veldt: Veldt, out: str, index: np.ndarray) -> None:
    labels = veldt.read(f"{out}/annotations.json")["annotations"]
    assert {label["track_id"] for label in labels} == set(np.unique(index)) - {0} == {2, 3, 4}
    for label in labels:
        assert (decode_rle(label["segmentation"]) == (index == label["track_id"])).all()


@pytest.mark.parametrize("matte, names", [("CryptoObject", OBJECTS), ("CryptoMaterial", MATERIALS)])
def test_masks_are_what_fills_most_of_each_pixel(rendered, matte, names):
    _convert(rendered, _manifest(matte, names), matte)
    _check_masks(rendered, matte, _expected_index(_ranks(rendered, matte, names)))


def test_where_an_object_fills_a_pixel_it_is_the_index_plane_s(rendered):
    index, coverage = _ranks(rendered, "CryptoObject", OBJECTS)[0]
    by_index = read_planes(rendered.folder / "passes" / "000000.exr")["ViewLayer.IndexOB.X"]
    whole = coverage >= 1
    assert whole.sum() > 200
    assert (index[whole] == by_index[whole]).all()


def _radiance(veldt: Veldt, name: str) -> float:
    material = veldt.read(ROOT / "assets" / "materials" / f"{name}.json")
    asked = ["--temperature-k", material["winter_k"], "--emissivity", material["emissivity"], "--json"]
    return veldt("radiance", *asked).json()["values"][0]["radiance_w_m2_sr"]


def test_edges_are_means_of_radiance(rendered):
    """Every pixel, by coverages read without the program."""
    _convert(rendered, _manifest("CryptoObject", OBJECTS), "edges")
    of_index = {0: "sky", 2: "elephant", 3: "human", 4: "zebra"}
    radiance = np.array([_radiance(rendered, of_index.get(index, "sky")) for index in range(5)])
    ranks = _ranks(rendered, "CryptoObject", OBJECTS)
    shares = [np.where(index > 0, coverage, 0) for index, coverage in ranks]
    mean = sum(share * radiance[index] for (index, _), share in zip(ranks, shares))
    mean += np.maximum(1 - sum(shares), 0) * radiance[0]
    levels, place = np.unique(mean, return_inverse=True)
    asked = ",".join(f"{level:.17g}" for level in levels)
    answers = rendered("radiance", "--radiance", asked, "--json").json()["values"]
    apparent_k = np.array([value["temperature_k"] for value in answers])[place].reshape(mean.shape)
    step_k = rendered.read("edges/dataset.json")["kelvin_per_count"]
    counts = read_grey(rendered.folder / "edges" / "clips" / "spheres" / "ir16" / "000000.png").astype(float)
    assert len(levels) > 20
    # Half a count of rounding; coverages and radiance are single precision: 8 roundings of 6e-8 at most, 5e-7 of the
    # radiance, which is 5e-5 K where dL/L is 1 % per K or more, or 5e-3 counts of 0.01 K.
    assert abs(counts - apparent_k / step_k).max() <= 0.505


def _attributes(file: Path) -> dict[str, str]:
    opened = OpenImageIO.ImageInput.open(str(file))
    texts = {each.name: each.value for each in opened.spec().extra_attribs if each.name.startswith("crypto")}
    opened.close()
    return texts


def test_blender_hashes_names_as_we_do(rendered):
    texts = _attributes(rendered.folder / "passes" / "000000.exr")
    (key,) = [name[: -len("/name")] for name, text in texts.items() if text == "ViewLayer.CryptoObject"]
    hashes = json.loads(texts[f"{key}/manifest"])
    assert set(hashes) == set(OBJECTS)
    for name, digits in hashes.items():
        assert mattes.hash_in_float(int(digits, 16)) == mattes.matte_hash(name)


def test_without_blender_s_manifest_names_are_hashed_to_the_same(rendered):
    """The program's hashes of names equal Blender's."""
    file = rendered.folder / "passes" / "000000.exr"
    planes = {name: plane for name, plane in read_planes(file).items() if ".CryptoObject" in name}
    (rendered.folder / "nameless").mkdir()
    texts = {name: text for name, text in _attributes(file).items() if not name.endswith("/manifest")}
    mattes.write_exr_with_texts(rendered.folder / "nameless" / "000000.exr", planes, texts)
    manifest = _manifest("CryptoObject", OBJECTS)
    _convert(rendered, manifest, "hashed", "nameless")
    _convert(rendered, manifest, "named")
    assert rendered.pixels("hashed") == rendered.pixels("named")
