"""Write the seeds for fuzzing: make_seeds.py FOLDER makes FOLDER/TARGET/… and dictionaries FOLDER/TARGET.dict.

The output is the same on every run. Every seed is valid for the readers of its target.
"""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path

from exr_seeds import write_exr_seeds
from picture_seeds import write_picture_seeds
from plan_seeds import write_plan_seeds
from png_seeds import write_png_seeds

ROOT = Path(__file__).resolve().parents[2]
CONFIGS, SCHEMAS, DATA = ROOT / "configs", ROOT / "configs" / "schema", ROOT / "tests" / "data"
FLIGHTS, CALIBRATIONS = DATA / "flights", DATA / "calibrations"

MANIFEST = {
    "format": "veldt-passes",
    "version": 1,
    "clip": "one",
    "scene": "made_up",
    "seed": 5,
    "camera": {"width_px": 8, "height_px": 8, "fx_px": 9, "fy_px": 9, "cx_px": 4, "cy_px": 4},
    "objects": [
        {"index": 1, "name": "ground", "class": "ground", "material": "soil", "colour": [90, 60, 30]},
        {
            "index": 101,
            "name": "walker",
            "class": "actor",
            "material": "human",
            "category": "human",
            "species": "human",
            "track_id": 7,
            "mattes": ["walker*"],
            "bounds_m": [[-0.3, -0.3, 0], [0.3, 0.3, 1.8]],
        },
    ],
    "materials": [{"index": 1, "material": "human", "part": "face"}],
    "frames": [
        {
            "file": "000000.exr",
            "time_s": 0,
            "agl_m": 61,
            "look_angle_deg": 45,
            "camera_to_world": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 61, 0, 0, 0, 1],
            "actors": [{"index": 101, "position_m": [1, 2, 0], "heading_rad": 0.5}],
        }
    ],
}
COCO = {
    "info": {"version": "1"},
    "images": [
        {"id": 1, "file_name": "a/0.png", "width": 8, "height": 6, "video_id": 3, "frame_index": 1},
        {"id": 2, "file_name": "b/1.png", "width": 8, "height": 6},
    ],
    "videos": [{"id": 3, "name": "n", "frame_rate_hz": 9}],
    "categories": [{"id": 2, "name": "lion"}],
    "annotations": [
        {
            "id": 5,
            "image_id": 1,
            "category_id": 2,
            "bbox": [1, 2, 3.5, 4],
            "area": 9,
            "iscrowd": 0,
            "track_id": 8,
            "visibility": 0.25,
            "occluded": True,
            "segmentation": {"size": [6, 8], "counts": [10, 5, 33]},
        }
    ],
}
CAMERA_TRAPS = {
    "images": [
        {"id": "s/2", "file_name": "s\\2.png", "width": 8, "height": 6, "seq_id": "night", "frame_num": 1},
        {"id": "s/1", "file_name": "s\\1.png", "width": 8, "height": 6, "seq_id": "night", "frame_num": 0},
    ],
    "categories": [{"id": 0, "name": "empty"}, {"id": 1.0, "name": "lion"}],
    "annotations": [
        {
            "id": "a",
            "image_id": "s/1",
            "category_id": 1,
            "bbox": [1, 2, 3.5, 4],
            "segmentation": [[1, 2, 4.5, 2, 4.5, 6, 1, 6], [0, 0, 1, 0, 1, 1]],
        },
        {"id": "b", "image_id": "s/2", "category_id": 0},
    ],
}
DRAWS = {
    "name": "d",
    "seed": 1,
    "sensor": {
        "noise": {"amount": {"uniform": [0, 1]}},
        "agc": {"choice": [{"mode": "linear"}, {"mode": "clahe"}]},
    },
    "weather": {"time": {"uniform": ["22:00", "04:00"]}, "wind_m_s": {"normal": [2, 1]}},
    "output": {"codec": {"choice": [None, {"name": "h264", "bitrate_kbit_s": 90}], "weights": [1, 2]}},
    "clips": [
        {
            "id": "a",
            "count": 2,
            "season": {"choice": ["winter", "summer"]},
            "frames": {"uniform": [1, 3]},
            "weather": {"air_temperature_k": {"choice": [280, {"uniform": [270, 290]}]}},
            "flight": {"pattern": "zigzag", "altitude_m": {"uniform": [30, 50]}},
        }
    ],
}
RESULTS = [{"image_id": 1, "category_id": 7, "bbox": [1, 2, 30.5, 40], "score": 0.5}]
NAMED_RESULTS = [
    {
        "image_id": "video_0",
        "file_name": "video_0.png",
        "category_id": 2,
        "bbox": [1, 2, 30.5, 40],
        "score": 0.5,
    },
    {"image_id": "1", "file_name": "video\\1.jpg", "category_id": 1, "bbox": [1, 2, 30.5, 40], "score": 0.5},
]
TEXTS = {
    "birdsai/rows.csv": "4,2,10,20,5,6,1,-1,0,0\r\n4,1,-3,0,8,9,0,1,1,0\n\n0, 1,1,2,3,4,0,-1,0,1\n",
    "coco/small.json": json.dumps(COCO),
    "coco/camera_traps.json": json.dumps(CAMERA_TRAPS),
    "config/settings.txt": "seed=3\nseason=summer\nsensor.preset=boson_640_14mm\nclips[1].frames=1\n"
    'weather.air_temperature_k=290\nsensor={"model": "physical"}',
    "config/tiny.json": '{"name": "t", "seed": 1, "clips": [{"id": "a", "season": "winter", "frames": 2,'
    ' "flight": {"pattern": "zigzag", "altitude_m": 61, "look_angle_deg": 90, "speed_m_s": 6,'
    ' "area_m": [0, 0, 9, 9], "heading_deg": 0}}]}',
    "config/draws.json": json.dumps(DRAWS),
    "detections/coco.json": json.dumps(RESULTS),
    "detections/names.json": json.dumps(NAMED_RESULTS),
    "detections/yolo.txt": "0 0.5 0.5 0.1 0.2 0.9\r\n1 0 1 1 1 1e-3\n",
    "manifest/small.json": json.dumps(MANIFEST),
    "manifest/sequence.json": json.dumps(
        {**MANIFEST, "frames": [], "sequence": "frame_####.exr", "cryptomatte": "CryptoObject"}
    ),
}
COPIES = {
    "calibration": [file for file in sorted(CALIBRATIONS.iterdir()) if file.suffix != ".md"],
    "config": [CONFIGS / "demo.json", CONFIGS / "savanna.json"],
    "dataset": [Path(__file__).with_name("dataset_seed.json")],
    "variants": [CONFIGS / "variants_example.json", CONFIGS / "gallery.json"],
    "plan": [FLIGHTS / "survey.plan"],
    "log": [FLIGHTS / "log.csv"],
}
WORDS = {
    "birdsai": ["-1", "2147483647", ",", "\r\n", " "],
    "calibration": "%YAML:1.0 --- !!opencv-matrix camera_matrix cameraMatrix Camera_Matrix distortion_coefficients"
    " dist_coeffs image_width image_height cameraResolution rows cols dt data fisheye_model distortion_model plumb_bob"
    " rectification_matrix M1 type_id opencv-matrix .Nan .Inf opencv_storage <data> </data> !!binary $base64$ cam0:"
    " intrinsics resolution camera_model pinhole radtan binning_x roi: xi { } - ... # & * | <<".split(),
    "coco": "images annotations categories videos image_id category_id bbox file_name seq_id frame_id frame_index"
    " frame_num empty segmentation counts size instance_id score bbox_mode".split(),
    "dataset": "../ ../../secret ../secret/key.png /dev/zero /etc/passwd @sum clips/one ir8/000000.png links files id"
    " record_sha256 file_name status done".split(),
    "detections": ["image_id", "category_id", "bbox", "score", "file_name", "bbox_mode", "1e308", "-1e308"],
    "exr_passes": "channels chlist compression dataWindow displayWindow box2i lineOrder pixelAspectRatio float v2f name"
    " screenWindowCenter screenWindowWidth string tiles tiledesc type scanlineimage tiledimage chunkCount int version"
    " cryptomatte/ /manifest /name /hash /conversion IndexOB.X IndexMA.X Depth.Z Normal.X Scene. Actors. .R .G .B .A"
    " CryptoObject00 /manif_file envmap".split(),
    "index_picture": ["IHDR", "PLTE", "IDAT", "IEND", "tRNS", "gAMA", "sRGB", "iCCP", "zTXt", "eXIf"],
    "picture": [
        "II*\0",
        "MM\0*",
        'role="scale">',
        'role="offset">',
        'role="unittype">',
        "nan",
        "1e308",
        "IHDR",
        "JFIF",
        "Exif\0\0",
        "http://ns.adobe.com/xap/1.0/\0",
        'drone-dji:RelativeAltitude="',
        'Camera:Pitch="',
        "0/0",
    ],
    "plan": [],
    "log": ["time_s", "x_m", "y_m", "z_m", "agl_m", "altitude_m", "yaw_deg", "nan", "inf", "1e308"],
}
SCHEMAS_OF = {
    "baked_scene": ["scene"],
    "config": ["config"],
    "ground_maps": ["ground_maps"],
    "manifest": ["manifest"],
    "scene_plan": ["plan", "config"],
    "tracks": ["track"],
    "variants": ["variants"],
}
TRACK_ARRAYS = (
    "time_s camera_to_world agl_m look_angle_deg actor_position_m actor_heading_rad posed bones".split()
)


def words_of_schema(schema) -> set[str]:
    """Keys and choices anywhere in a schema."""
    if isinstance(schema, list):
        return {word for part in schema for word in words_of_schema(part)}
    if not isinstance(schema, dict):
        return set()
    words = set(schema.get("properties", {})) | {
        word for word in schema.get("enum", []) if isinstance(word, str)
    }
    return words | {word for part in schema.values() for word in words_of_schema(part)}


def plan_words() -> list[str]:
    """Keys of the plan that is a seed."""
    return sorted(
        {line.split('"')[1] for line in COPIES["plan"][0].read_text("utf-8").splitlines() if '": ' in line}
    )


def write_dictionary(file: Path, words: list[str]) -> None:
    """In the form of libFuzzer and AFL."""
    lines = ['"' + "".join(f"\\x{byte:02x}" for byte in word.encode()) + '"\n' for word in words]
    file.write_text("".join(lines), encoding="utf-8")


def main(folder: Path) -> None:
    """Write all seeds."""
    shutil.rmtree(folder, ignore_errors=True)
    words = dict(WORDS) | {"plan": plan_words()}
    for target, names in SCHEMAS_OF.items():
        schemas = [
            json.loads((SCHEMAS / f"{name}.schema.json").read_text(encoding="utf-8")) for name in names
        ]
        words[target] = sorted(words_of_schema(schemas))
    words["ground_maps"] += "sky_view height_m crown_top_m moisture sunlit water_m".split()
    words["ground_maps"] += "fine_cells kinds kind grass trodden ash border".split()
    words["tracks"] += TRACK_ARRAYS
    for target, known in words.items():
        (folder / target).mkdir(parents=True)
        write_dictionary(folder / f"{target}.dict", known)
    for name, text in TEXTS.items():
        (folder / name).write_bytes(text.encode("utf-8"))
    for target, files in COPIES.items():
        for file in files:
            shutil.copyfile(file, folder / target / file.name)
    write_exr_seeds(folder / "exr_passes")
    write_picture_seeds(folder / "picture")
    write_png_seeds(folder / "index_picture")
    write_plan_seeds(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
