"""Labels of a rendered dataset, checked against its index planes and the positions of actors in the manifest."""

import itertools

import numpy as np
import pytest

from configs import CLIPS, FRAMES, tiny
from labels import box_of, check_labels, decode_rle
from pictures import read_planes
from program import Veldt

WIDTH, HEIGHT = 320, 256
ALONE = "Actors.IndexOB.X"


def _apart(config: dict) -> None:
    """No occlusion: no plants, and groups far from each other. Every group is followed by a clip."""
    config["scene"]["plants"] = {}
    for k, group in enumerate(config["scene"]["groups"]):
        group.update(start_m=50 * k, spacing_m=6 + 2 * k)
    config["camera"] = {"width_px": WIDTH, "height_px": HEIGHT, "pixel_pitch_um": 30}
    config["render"]["actor_layer"] = True
    azimuths_deg = {"people": 20, "herd": 70, "zebras": 160}
    config["clips"] = [
        {
            "id": f"{target}_{look_angle_deg}",
            "season": "winter",
            "frames": 4,
            "frame_rate_hz": 3,
            "flight": {
                "pattern": "follow",
                "target": target,
                "look_angle_deg": look_angle_deg,
                "azimuth_deg": azimuth_deg,
                "altitude_m": 25,
            },
        }
        for target, azimuth_deg in azimuths_deg.items()
        for look_angle_deg in (90, 45)
    ]


OVERSCAN = 100


def _in_a_thicket(config: dict) -> None:
    """A low view through trees, with actors beyond the borders of the picture."""
    config["scene"]["plants"] = {"acacia": {"per_ha": 400}}
    config["camera"] = {"width_px": WIDTH, "height_px": HEIGHT, "pixel_pitch_um": 30}
    for clip, view in zip(config["clips"], ({"altitude_m": 20, "speed_m_s": 3}, {"look_angle_deg": 15})):
        clip["flight"].update(view)
        clip["frames"], clip["frame_rate_hz"] = 16, 4
    config["render"] |= {"actor_layer": True, "overscan_px": OVERSCAN}


def _picture(plane: np.ndarray, manifest: dict) -> np.ndarray:
    """The part of a plane of passes that is in the picture."""
    cut_px = manifest["overscan_px"]
    height, width = plane.shape
    return plane[cut_px : height - cut_px, cut_px : width - cut_px]


class Dataset:
    """A dataset that was generated with its passes kept."""

    def __init__(self, folder, blender: str, config: dict):
        veldt = Veldt(folder)
        veldt.write("config.json", config)
        done = veldt(
            "generate", "config.json", "--out", ".", "--keep-passes", "--quiet", "--blender", blender
        )
        assert (done.code, done.out, done.err) == (0, "", "")
        self.labels = veldt.read("annotations.json")
        self.manifests = {c["id"]: veldt.read(f'passes/{c["id"]}/manifest.json') for c in config["clips"]}
        self.passes = {
            f"clips/{clip}/ir8/{k:06d}.png": read_planes(folder / "passes" / clip / f"{k:06d}.exr")
            for clip, manifest in self.manifests.items()
            for k in range(len(manifest["frames"]))
        }
        self.planes = self.pictures("Scene.IndexOB.X")

    def pictures(self, channel: str) -> dict[str, np.ndarray]:
        """A plane of each picture, without overscan, by file name."""
        return {
            name: _picture(planes[channel], self.manifests[name.split("/")[1]])
            for name, planes in self.passes.items()
        }

    def sightings(self):
        """(label, actor, manifest, frame of the manifest) of every label."""
        images = {image["id"]: image for image in self.labels["images"]}
        for label in self.labels["annotations"]:
            image = images[label["image_id"]]
            manifest = self.manifests[image["file_name"].split("/")[1]]
            (actor,) = (o for o in manifest["objects"] if o.get("track_id") == label["track_id"])
            yield label, actor, manifest, manifest["frames"][image["frame_index"]]


@pytest.fixture(scope="module", name="full")
def _full(tmp_path_factory, blender) -> Dataset:
    return Dataset(tmp_path_factory.mktemp("full"), blender, tiny())


@pytest.fixture(scope="module", name="apart")
def _apart_dataset(tmp_path_factory, blender) -> Dataset:
    return Dataset(tmp_path_factory.mktemp("apart"), blender, tiny(_apart))


@pytest.fixture(scope="module", name="thicket")
def _thicket(tmp_path_factory, blender) -> Dataset:
    return Dataset(tmp_path_factory.mktemp("thicket"), blender, tiny(_in_a_thicket))


def test_every_label_holds_exactly_its_actors_pixels(full, apart):
    assert len(full.planes) == len(CLIPS) * FRAMES
    assert check_labels(full.labels, full.planes, full.manifests) > 40
    assert check_labels(apart.labels, apart.planes, apart.manifests, apart.pictures(ALONE)) > 40


def corners_px(manifest: dict, frame: dict, actor: dict) -> np.ndarray:
    """Picture points (2, 2, 2, 2) of the actor's box: [back or front, right or left, bottom or top, x or y]."""
    (place,) = (a for a in frame["actors"] if a["index"] == actor["index"])
    cos, sin = np.cos(place["heading_rad"]), np.sin(place["heading_rad"])
    axes = np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]])  # forward, left, up
    picks = np.array(list(itertools.product((0, 1), repeat=3)))
    local_m = np.where(picks == 0, actor["bounds_m"][0], actor["bounds_m"][1])
    world_m = local_m @ axes + place["position_m"]
    pose = np.array(frame["camera_to_world"]).reshape(4, 4)
    x, y, depth = ((world_m - pose[:3, 3]) @ pose[:3, :3]).T
    assert (depth > 0).all()
    lens = manifest["camera"]
    pixels = np.stack(
        [lens["fx_px"] * x / depth + lens["cx_px"], lens["fy_px"] * y / depth + lens["cy_px"]], axis=-1
    )
    return pixels.reshape(2, 2, 2, 2)


def test_labels_lie_within_their_actors_projected_box(full, apart):
    """A pixel is labelled if its centre is inside the body, and the label's edge is half a pixel beyond the centre.

    The manifest's poses are rounded to 1e-6 m and 1e-9, and Blender's are float32: 0.01 px covers both many times.
    """
    for label, actor, manifest, frame in itertools.chain(full.sightings(), apart.sightings()):
        points = corners_px(manifest, frame, actor).reshape(-1, 2)
        x, y, width, height = label["bbox"]
        assert (np.array([x, y]) >= points.min(axis=0) - 0.51).all()
        assert (np.array([x + width, y + height]) <= points.max(axis=0) + 0.51).all()


# Faces of the box that a body touches at every moment of its stride, as (axis, side): a walker's arms at left and
# right and its head at the top; of an animal also head and tail. Legs swing, so the rest is touched now and then.
ALWAYS_TOUCHED = {
    "human": [(1, 0), (1, 1), (2, 1)],
    "elephant": [(0, 0), (0, 1), (1, 0), (1, 1), (2, 1)],
    "zebra": [(0, 0), (0, 1), (1, 0), (1, 1), (2, 1)],
}
# Tails, tusks and ears end in tips narrower than a pixel, which can fall between the centres of pixels. By the
# species files none is longer than this beyond the part that is a pixel wide.
TIP_M = 0.35


def test_labels_reach_as_far_as_their_actors_do(apart):
    """A body touches a face of its box somewhere, so it reaches at least as far as the face's nearest corner.

    The last pixel centre inside is less than a pixel from there, and the label's edge half a pixel beyond that one.
    """
    species = set()
    for label, actor, manifest, frame in apart.sightings():
        if label["truncated"]:
            continue
        species.add(actor["species"])
        corners = corners_px(manifest, frame, actor)
        faces = [
            np.take(corners, side, axis=axis).reshape(4, 2) for axis, side in ALWAYS_TOUCHED[actor["species"]]
        ]
        scale_px_m = manifest["camera"]["fx_px"] / frame["agl_m"]  # or less, for those who are farther away
        slack_px = 0.5 + TIP_M * scale_px_m
        x, y, width, height = label["bbox"]
        assert (
            np.array([x + width, y + height]) >= np.max([f.min(axis=0) for f in faces], axis=0) - slack_px
        ).all()
        assert (np.array([x, y]) <= np.min([f.max(axis=0) for f in faces], axis=0) + slack_px).all()
    assert species == set(ALWAYS_TOUCHED)


def test_in_the_open_actors_are_wholly_visible(apart):
    """Except for the parts of their feet below the ground."""
    visibility = np.array([label["visibility"] for label in apart.labels["annotations"]])
    assert visibility.min() > 0.9 and np.median(visibility) == 1


def test_behind_trees_actors_are_as_visible_as_their_pixels_say(thicket):
    count = check_labels(thicket.labels, thicket.planes, thicket.manifests, thicket.pictures(ALONE))
    visibility = np.array([label["visibility"] for label in thicket.labels["annotations"]])
    assert count > 10 and np.count_nonzero(visibility < 0.5) > 2
    assert any(label["visibility"] < 1 and _is_split(label) for label in thicket.labels["annotations"])


def _is_split(label: dict) -> bool:
    """Whether there are empty columns between columns with pixels."""
    columns = decode_rle(label["segmentation"]).any(axis=0)
    first, last = np.flatnonzero(columns)[[0, -1]]
    return not columns[first : last + 1].all()


def test_the_whole_box_is_that_of_the_actor_behind_trees(thicket):
    """Within the picture exactly; beyond its borders, where overscan shows the truth, to half of the actor's side."""
    images = {image["id"]: image["file_name"] for image in thicket.labels["images"]}
    cut = 0
    for label, actor, manifest, _ in thicket.sightings():
        plane = thicket.passes[images[label["image_id"]]][ALONE]
        x, y, width, height = box_of(_picture(plane, manifest) == actor["index"])
        left, top, wide, high = label["amodal_bbox"]
        inside = np.array([x, y, x + width, y + height])
        labelled_px = np.array([left, top, left + wide, top + high])
        border = np.array([0, 0, manifest["camera"]["width_px"], manifest["camera"]["height_px"]])
        touched = inside == border
        # Corners are rounded to 0.01 px.
        assert labelled_px[~touched] == pytest.approx(inside[~touched], abs=0.011)
        assert label["truncated"] == touched.any()
        shown = np.minimum(labelled_px[2:], border[2:]) - np.maximum(labelled_px[:2], 0)
        assert label["truncated_fraction"] == pytest.approx(1 - shown.prod() / (wide * high), abs=2e-3)
        x, y, width, height = box_of(plane == actor["index"])
        whole = np.array([x, y, x + width, y + height]) - OVERSCAN
        seen_to_its_end = (whole > -OVERSCAN) & (whole < border + OVERSCAN)
        checked = touched & seen_to_its_end
        assert (np.abs(labelled_px - whole) <= 0.5 * np.array([width, height, width, height]) + 0.5)[
            checked
        ].all()
        cut += np.count_nonzero(checked)
    assert cut > 3


def test_range_is_the_distance_to_the_middle_of_the_box(thicket, apart):
    for label, actor, _, frame in itertools.chain(thicket.sightings(), apart.sightings()):
        (place,) = (a for a in frame["actors"] if a["index"] == actor["index"])
        forward, left, up = np.mean(actor["bounds_m"], axis=0)
        cos, sin = np.cos(place["heading_rad"]), np.sin(place["heading_rad"])
        middle_m = place["position_m"] + np.array(
            [cos * forward - sin * left, sin * forward + cos * left, up]
        )
        camera_m = np.array(frame["camera_to_world"]).reshape(4, 4)[:3, 3]
        assert label["range_m"] == pytest.approx(np.linalg.norm(middle_m - camera_m), abs=1e-4)


def test_animals_stand_out_of_a_winters_ground(apart):
    """Ground at 265 to 272 K, animals and people from 280 K; a target of few pixels loses some of it to blur."""
    seasons = {label["contrast_k"] > 0 for label in apart.labels["annotations"]}
    assert seasons == {True}
    assert all(label["contrast_noise"] > 0 for label in apart.labels["annotations"])
