"""A small detector of people that two processor cores train in minutes: centres as peaks (Zhou et al. 2019, "Objects as
points"), at a quarter of the resolution.
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import torch
from torch import nn
from torch.nn import functional

from frames import STRIDE, Crops, normalised, targets_of

_CHANNELS = 32
_DILATIONS = (1, 2, 4, 1)
_PRIOR = -4.6  # logit of 0.01: most cells hold no one
_BATCH = 12
_MOST = 60  # detections a frame
_NORM = 5.0


def _layer(inputs: int, outputs: int, stride: int = 1, dilation: int = 1) -> nn.Sequential:
    convolution = nn.Conv2d(inputs, outputs, 3, stride, dilation, dilation=dilation, bias=False)
    return nn.Sequential(convolution, nn.BatchNorm2d(outputs), nn.ReLU(inplace=True))


class Detector(nn.Module):
    """From pictures (n, 1, h, w) to (n, 5, h / 4, w / 4): logit of a peak, offset x and y, log width and height."""

    def __init__(self):
        super().__init__()
        self.stem = nn.Sequential(_layer(1, 16, stride=2), _layer(16, _CHANNELS, stride=2))
        self.body = nn.ModuleList([_layer(_CHANNELS, _CHANNELS, dilation=each) for each in _DILATIONS])
        self.head = nn.Conv2d(_CHANNELS, 5, 1)
        nn.init.zeros_(self.head.bias)
        self.head.bias.data[0] = _PRIOR

    def forward(self, pictures):
        """The five planes."""
        features = self.stem(pictures)
        for layer in self.body:
            features = features + layer(features)
        return self.head(features)


def train(crops: Crops, steps: int, seed: int, rate: float, start: Path | None = None) -> Detector:
    """A detector trained on random crops, from `start` or from nothing."""
    torch.manual_seed(seed)
    detector = Detector()
    if start is not None:
        detector.load_state_dict(torch.load(start))
    optimiser = torch.optim.AdamW(detector.parameters(), rate, weight_decay=1e-4)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, rate, total_steps=steps)
    for _ in range(steps):
        pictures, boxes_px = crops.draw(_BATCH)
        targets = [torch.from_numpy(np.stack(each)) for each in zip(*map(targets_of, boxes_px))]
        loss = _loss(detector(torch.from_numpy(pictures)[:, None]), *targets)
        optimiser.zero_grad()
        loss.backward()
        nn.utils.clip_grad_norm_(detector.parameters(), _NORM)
        optimiser.step()
        schedule.step()
    return detector.eval()


def _loss(planes, peaks, shapes, counts):
    """Focal loss of the peaks, and the distance of the shapes where there is a person."""
    found = torch.sigmoid(planes[:, 0]).clamp(1e-4, 1 - 1e-4)
    is_peak = (counts > 0).float()
    missed = is_peak * (1 - found) ** 2 * torch.log(found)
    false = (1 - is_peak) * (1 - peaks) ** 4 * found**2 * torch.log(1 - found)
    people = counts.sum().clamp(min=1)
    off = functional.smooth_l1_loss(planes[:, 1:], shapes, reduction="none") * counts[:, None]
    return (off.sum() - (missed + false).sum()) / people


def detect(detector: Detector, file: Path) -> np.ndarray:
    """The detections (n, 5) in a picture: x, y, width, height in px, and score."""
    grey = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE)
    high, wide = (-(-side // STRIDE) * STRIDE for side in grey.shape)
    padded = np.zeros((high, wide), np.float32)
    padded[: grey.shape[0], : grey.shape[1]] = normalised(grey)
    with torch.no_grad():
        planes = detector(torch.from_numpy(padded)[None, None])[0]
    peaks = torch.sigmoid(planes[0])
    peaks = peaks * (functional.max_pool2d(peaks[None, None], 3, 1, 1)[0, 0] == peaks)
    scores, cells = peaks.flatten().topk(_MOST)
    row, column = torch.div(cells, peaks.shape[1], rounding_mode="floor"), cells % peaks.shape[1]
    x, y, log_wide, log_high = planes[1:, row, column]
    size = torch.exp(torch.stack([log_wide, log_high])) * STRIDE
    middle = torch.stack([column + x, row + y]) * STRIDE
    return torch.cat([middle - size / 2, size, scores[None]]).T.numpy()
