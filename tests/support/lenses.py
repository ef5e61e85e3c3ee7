"""Lenses by their formula, to check labels against the positions of actors in a manifest."""

import itertools

import numpy as np

WIDTH, HEIGHT = 320, 256
LENS = {"k1": -0.2, "k2": 0.03, "p1": 0.001, "p2": -0.0005, "k3": 0}
PINHOLE = dict.fromkeys(LENS, 0)
CAMERA = {"width_px": WIDTH, "height_px": HEIGHT, "pixel_pitch_um": 30, "distortion": LENS}


def behind_a_lens(config: dict) -> None:
    """All actors in the open, seen from above and from the side, up to the corners of the picture."""
    config["scene"]["plants"] = {}
    config["camera"] = CAMERA
    config["clips"] = [
        {
            "id": f"{target}_{look_angle_deg}",
            "season": "winter",
            "frames": 3,
            "frame_rate_hz": 1,
            "flight": {
                "pattern": "follow",
                "target": target,
                "look_angle_deg": look_angle_deg,
                "azimuth_deg": 70,
                "altitude_m": 25,
            },
        }
        for target, look_angle_deg in (("people", 90), ("herd", 45), ("zebras", 60))
    ]


def edges_of_box(frame: dict, actor: dict) -> np.ndarray:
    """Normalised points (n, 2), x and y at depth 1, all along the edges of the actor's box.

    Edges, because the lens bends them: a box reaches further than its corners.
    """
    (place,) = (a for a in frame["actors"] if a["index"] == actor["index"])
    cos, sin = np.cos(place["heading_rad"]), np.sin(place["heading_rad"])
    axes = np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]])  # forward, left, up
    corners = np.array(list(itertools.product((0, 1), repeat=3)))
    low, high = np.array(actor["bounds_m"])
    ends = [(a, b) for a, b in itertools.combinations(corners, 2) if np.abs(a - b).sum() == 1]
    share = np.linspace(0, 1, 33)[:, None]
    picks = np.concatenate([a + share * (b - a) for a, b in ends])
    world_m = (low + picks * (high - low)) @ axes + place["position_m"]
    pose = np.array(frame["camera_to_world"]).reshape(4, 4)
    x, y, depth = ((world_m - pose[:3, 3]) @ pose[:3, :3]).T
    assert (depth > 0).all()
    return np.stack([x / depth, y / depth], axis=-1)


def distort(points: np.ndarray, lens: dict) -> np.ndarray:
    """OpenCV's formula (Camera Calibration and 3D Reconstruction, "Detailed Description")."""
    x, y = points[..., 0], points[..., 1]
    r2 = x * x + y * y
    radial = 1 + lens["k1"] * r2 + lens["k2"] * r2 * r2 + lens["k3"] * r2 * r2 * r2
    return np.stack(
        [
            x * radial + 2 * lens["p1"] * x * y + lens["p2"] * (r2 + 2 * x * x),
            y * radial + lens["p1"] * (r2 + 2 * y * y) + 2 * lens["p2"] * x * y,
        ],
        axis=-1,
    )


def undistort(points: np.ndarray, lens: dict) -> np.ndarray:
    """The inverse by steps of the difference: the slope is within 0.25 of 1 here, so two steps gain a digit."""
    seen = points
    for _ in range(40):
        seen = seen + (points - distort(seen, lens))
    return seen


def to_px(points: np.ndarray, camera: dict) -> np.ndarray:
    scale, centre = (camera["fx_px"], camera["fy_px"]), (camera["cx_px"], camera["cy_px"])
    return points * scale + centre


def sightings(annotations: dict, manifests: dict):
    """(label, points along the edges of its actor's box in normalised coordinates, manifest) of every label."""
    images = {image["id"]: image for image in annotations["images"]}
    for label in annotations["annotations"]:
        image = images[label["image_id"]]
        manifest = manifests[image["file_name"].split("/")[1]]
        (actor,) = (o for o in manifest["objects"] if o.get("track_id") == label["track_id"])
        yield label, edges_of_box(manifest["frames"][image["frame_index"]], actor), manifest


def check_inside(annotations: dict, manifests: dict, lens: dict, slack_px: float) -> float:
    """Check that every label lies within its actor's projected box; return the largest shift by the lens in px."""
    moved_px = 0.0
    for label, edges, manifest in sightings(annotations, manifests):
        points = to_px(distort(edges, lens), manifest["camera"])
        x, y, width, height = label["bbox"]
        assert (np.array([x, y]) >= points.min(axis=0) - slack_px).all()
        assert (np.array([x + width, y + height]) <= points.max(axis=0) + slack_px).all()
        if not label["truncated"]:
            moved_px = max(moved_px, np.abs(points - to_px(edges, manifest["camera"])).max())
    return moved_px
