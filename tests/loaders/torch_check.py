#!/usr/bin/env python3
"""Does veldt.torch give PyTorch what the dataset has, also after torchvision's transforms?

    tests/loaders/torch_check.py DATASET

Run by `./run loaders`, with the packages `torch` and `torchvision`. Pixels, boxes, masks, tracks and ids must be those
of the files as OpenCV and pycocotools read them. Frames must have at least 480 x 384 px.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import torch
import torchvision
from torch.utils.data import DataLoader
from torchvision import tv_tensors
from torchvision.models.detection import maskrcnn_resnet50_fpn
from torchvision.ops import masks_to_boxes
from torchvision.transforms import InterpolationMode, v2

from truth import Truth, arguments, read_truth
from veldt import open_dataset
from veldt.torch import FrameDataset, collate, per_label, results

_STEP = 7  # of frames, for what takes long


def _check_target(target: dict, picture) -> None:
    assert np.array_equal(target["boxes"].numpy(), picture.corners_px())
    assert target["boxes"].canvas_size == (picture.image["height"], picture.image["width"])
    assert target["labels"].tolist() == picture.of("category_id")
    assert target["track_ids"].tolist() == picture.of("track_id")
    assert np.array_equal(target["masks"].numpy(), picture.masks())
    assert target["image_id"] == picture.image["id"]


def check_frames(truth: Truth) -> str:
    """Every frame in all three kinds of pixels."""
    sets = {pixels: FrameDataset(truth.folder, pixels=pixels) for pixels in ("ir8", "ir16", "ir16_k")}
    assert all(len(frames) == len(truth.pictures) for frames in sets.values())
    assert sets["ir8"].categories == truth.categories
    for at, picture in enumerate(truth.pictures):
        counts = picture.pixels("ir16")
        (ir8, target), (ir16, _), (ir16_k, _) = (frames[at] for frames in sets.values())
        assert (ir8.dtype, ir16.dtype, ir16_k.dtype) == (torch.uint8, torch.int32, torch.float32)
        assert np.array_equal(ir8[0], picture.pixels("ir8")) and np.array_equal(ir16[0], counts)
        assert np.array_equal(ir16_k[0], np.float32(counts * truth.kelvin_per_count))
        assert np.array_equal(np.rint(ir16_k[0].numpy() / truth.kelvin_per_count), counts)
        _check_target(target, picture)
    return f"{len(truth.pictures)} frames and {truth.targets} targets agree; kelvin give every count back"


def check_splits(truth: Truth) -> str:
    """A set of some clips has their frames alone."""
    for clip in truth.clips:
        ids = [target["image_id"] for _, target in FrameDataset(truth.folder, clips=[clip], masks=False)]
        assert ids == [picture.image["id"] for picture in truth.pictures if picture.clip == clip]
    return f"each of {len(truth.clips)} clips alone has its own frames"


def check_ignored(truth: Truth) -> str:
    """Labels that are marked `ignore` are left out, unless they are asked for."""
    dataset = open_dataset(truth.folder)
    at = next(at for at, picture in enumerate(truth.pictures) if picture.labels)
    tracks = truth.pictures[at].of("track_id")
    sets = [FrameDataset(dataset, ignored=ignored) for ignored in (False, True)]
    sets[0].frame(at).labels[0].values["ignore"] = True
    found = [frames[at][1]["track_ids"].tolist() for frames in sets]
    assert found == [tracks[1:], tracks], found
    return "a label marked as ignored is left out, unless it is asked for"


def check_flip(truth: Truth) -> str:
    """A horizontal flip moves pixels, boxes and masks alike, and keeps all counts."""
    frames = FrameDataset(truth.folder, pixels="ir16", transforms=v2.RandomHorizontalFlip(1))
    for (image, target), picture in zip(frames, truth.pictures):
        assert image.dtype == torch.int32 and np.array_equal(image[0], picture.pixels("ir16")[:, ::-1])
        left, top, right, bottom = picture.corners_px().T
        width = picture.image["width"]
        assert np.array_equal(target["boxes"], np.stack([width - right, top, width - left, bottom], 1))
        assert np.array_equal(target["masks"], picture.masks()[:, :, ::-1])
    return f"flipped: pixels, {truth.targets} boxes and masks agree"


def check_resize(truth: Truth) -> str:
    """Doubled without interpolation, every count, box and mask is known."""
    picture = truth.pictures[0]
    size = [2 * picture.image["height"], 2 * picture.image["width"]]
    nearest = v2.Resize(size, interpolation=InterpolationMode.NEAREST)
    frames = FrameDataset(truth.folder, pixels="ir16", transforms=nearest)
    for at in range(0, len(frames), _STEP):
        (image, target), picture = frames[at], truth.pictures[at]
        assert np.array_equal(image[0], np.kron(picture.pixels("ir16"), np.ones((2, 2), int)))
        assert np.array_equal(target["boxes"], 2 * picture.corners_px())
        assert np.array_equal(target["masks"], picture.masks().repeat(2, 1).repeat(2, 2))
        if len(target["boxes"]):
            assert np.array_equal(
                masks_to_boxes(target["masks"]) + torch.tensor([0, 0, 1, 1]), target["boxes"]
            )
    return f"doubled: pixels, boxes and masks of every {_STEP}th frame agree"


def _halved(counts: np.ndarray) -> np.ndarray:
    """What torchvision's antialiasing makes of them, without the border: 4 x 4 px weighed by 1, 3, 3, 1."""
    for _ in range(2):
        n = counts.shape[0] // 2 - 2
        counts = sum(w / 8 * counts[1 + k : 1 + k + 2 * n : 2] for k, w in enumerate((1, 3, 3, 1))).T
    return counts


def check_halved(truth: Truth) -> str:
    """Halved with interpolation, pixels are means of counts or kelvin: 16 bits stay."""
    picture = truth.pictures[0]
    half = v2.Resize([picture.image["height"] // 2, picture.image["width"] // 2])
    fewest = 1 << 16
    for pixels, count in (("ir16", 1), ("ir16_k", truth.kelvin_per_count)):
        frames = FrameDataset(truth.folder, pixels=pixels, transforms=half)
        for at in range(0, len(frames), _STEP):
            counts = truth.pictures[at].pixels("ir16").astype(float)
            image = frames[at][0][0].numpy()
            # 16 products and sums in single precision; counts are then rounded.
            bound = 16 * counts.max() * 2**-24 + (0.5 if count == 1 else 0)
            assert np.abs(image[1:-1, 1:-1] / count - _halved(counts)).max() < bound
            fewest = min(fewest, len(np.unique(image)))
    assert fewest > 256
    return f"halved: means of counts, at least {fewest} different ones in a frame"


def check_crop(truth: Truth) -> str:
    """What is cropped away, v2.SanitizeBoundingBoxes removes with its label, track and mask."""
    left, top = 160, 128
    size = {"height": 256, "width": 320}
    crop = v2.Lambda(lambda image: v2.functional.crop(image, top, left, *size.values()), tv_tensors.TVTensor)
    sane = v2.SanitizeBoundingBoxes(labels_getter=per_label)
    kept = 0
    for (_, target), picture in zip(
        FrameDataset(truth.folder, transforms=v2.Compose([crop, sane])), truth.pictures
    ):
        masks = picture.masks()[:, top : top + size["height"], left : left + size["width"]]
        boxes = picture.corners_px() - [left, top, left, top]
        inside = np.clip(boxes, 0, [size["width"], size["height"]] * 2)
        stays = ((inside[:, 2:] - inside[:, :2]) >= 1).all(1)
        assert np.array_equal(target["boxes"], inside[stays])
        assert np.array_equal(target["masks"], masks[stays])
        assert target["track_ids"].tolist() == np.array(picture.of("track_id"))[stays].tolist()
        assert target["labels"].tolist() == np.array(picture.of("category_id"))[stays].tolist()
        kept += int(stays.sum())
    assert 0 < kept < truth.targets
    return f"cropped: {kept} of {truth.targets} targets stay, with their labels, tracks and masks"


def check_workers(truth: Truth) -> str:
    """Worker processes give what this one gives."""
    frames = FrameDataset(truth.folder)
    for start in ("fork", "spawn", "forkserver"):
        loader = DataLoader(frames, 8, num_workers=2, collate_fn=collate, multiprocessing_context=start)
        found = [pair for batch in loader for pair in zip(*batch)]
        assert len(found) == len(frames)
        for at in range(0, len(frames), _STEP):
            (image, target), (other, others) = frames[at], found[at]
            assert isinstance(other, tv_tensors.Image) and torch.equal(image, other)
            assert all(torch.equal(target[key], others[key]) for key in target if key != "image_id")
            assert target["image_id"] == others["image_id"]
    return "workers started by fork, spawn and forkserver give the same"


def check_model(truth: Truth) -> str:
    """A step of training of a Mask R-CNN on kelvin: torchvision makes three channels of one."""
    torch.manual_seed(1)
    most = max(truth.categories.values())
    model = maskrcnn_resnet50_fpn(
        weights=None, weights_backbone=None, num_classes=most + 1, image_mean=[290] * 3, image_std=[10] * 3
    )
    frames = FrameDataset(truth.folder)
    busiest = sorted(range(len(frames)), key=lambda at: -len(truth.pictures[at].labels))[:1]
    empty = [at for at, picture in enumerate(truth.pictures) if not picture.labels][:1]
    losses = model(*collate([frames[at] for at in busiest + empty]))
    sum(losses.values()).backward()
    assert all(torch.isfinite(loss) for loss in losses.values()), losses
    assert all(p.grad is None or p.grad.isfinite().all() for p in model.parameters())
    return "Mask R-CNN, one step: " + ", ".join(f"{name} {loss:.3g}" for name, loss in losses.items())


def check_results(truth: Truth, veldt: Path) -> str:
    """The truth as a model's outputs is perfect for `veldt evaluate`."""
    targets = [target for _, target in FrameDataset(truth.folder, masks=False)]
    outputs = [target | {"scores": torch.ones(len(target["labels"]))} for target in targets]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(results(outputs, targets), file)
        file.flush()
        command = [veldt, "evaluate", "--truth", truth.folder, "--detections", file.name, "--json"]
        found = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    assert found["detections_read"] == truth.targets
    assert found["average_precision"] == {"ap50": 1, "ap50_95": 1}, found["average_precision"]
    return f"veldt evaluate: {truth.targets} targets given back have an average precision of 1"


def main() -> None:
    """Check a dataset."""
    options = arguments(__doc__)
    truth = read_truth(options.dataset)
    print(f"torch {torch.__version__}, torchvision {torchvision.__version__}")
    checks = (
        check_frames,
        check_splits,
        check_ignored,
        check_flip,
        check_resize,
        check_halved,
        check_crop,
        check_workers,
        check_model,
    )
    for check in checks:
        print(check(truth), flush=True)
    print(check_results(truth, options.veldt))


if __name__ == "__main__":
    main()
