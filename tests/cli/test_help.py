"""Help texts and usage faults of the command line."""

import re

import pytest

COMMON = {"--help", "--quiet", "--progress", "--threads"}
RENDERING = {
    "--plan",
    "--out",
    "--clips",
    "--shard",
    "--jobs",
    "--engine",
    "--blender",
    "--set",
    "--dry-run",
}
OPTIONS = {
    "generate": RENDERING | {"--scratch", "--keep-passes", "--max-unusable-share"},
    "plan": {"--out", "--engine", "--blender", "--set"},
    "render": RENDERING | {"--preview"},
    "convert": {
        "--out",
        "--manifest",
        "--config",
        "--dry-run",
        "--variants",
        "--set",
        "--strict",
        "--max-megapixels",
        "--max-unusable-share",
    },
    "merge": {"--plan", "--shards", "--out", "--link"},
    "cluster": {"--nodes", "--shards", "--cores", "--memory-gb", "--data", "--image", "--claim", "--out"},
    "export": {
        "--format",
        "--box-style",
        "--like",
        "--like-frames",
        "--out",
        "--link",
        "--images",
        "--segmentation",
        "--tiff-type",
        "--origin",
        "--split",
        "--seed",
        "--selection",
        "--samples-per-shard",
        "--scratch",
        "--unfinished",
    },
    "inspect": {
        "--manifest",
        "--layer",
        "--all-frames",
        "--starter-manifest",
        "--max-megapixels",
        "--json",
    },
    "validate": {"--set", "--json"},
    "balance": {"--per-class", "--out", "--seed", "--gap", "--time-limit-s", "--json"},
    "evaluate": {"--truth", "--detections", "--iou", "--score", "--count-ignored", "--json"},
    "compare": {
        "--real-labels",
        "--labels",
        "--real-names",
        "--names",
        "--category",
        "--box-style",
        "--kelvin",
        "--real-kelvin-per-count",
        "--real-unit",
        "--kelvin-per-count",
        "--unit",
        "--frames",
        "--html",
        "--json",
    },
    "fit": {
        "--config",
        "--out",
        "--real-labels",
        "--category",
        "--clips",
        "--frames",
        "--trials",
        "--seed",
        "--set",
        "--json",
    },
    "report": {"--out", "--unfinished"},
    "video": {
        "--out",
        "--clips",
        "--palette",
        "--boxes",
        "--tracks",
        "--scale",
        "--range",
        "--side-by-side",
        "--frame",
        "--width-px",
    },
    "view": {"--out", "--clips"},
    "stream": {"--video", "--labels", "--clips", "--rate", "--repeat", "--allow-remote", "--set"},
    "budget": {"--set", "--json"},
    "heat": {"--set", "--plot", "--surfaces", "--json"},
    "radiance": {
        "--temperature-k",
        "--radiance",
        "--band-um",
        "--response",
        "--emissivity",
        "--method",
        "--json",
    },
    "camera": {"--views"},
    "bench": {"--suite", "--only", "--blender", "--json"},
    "doctor": {"--json"},
}
COMMANDS = ", ".join(OPTIONS)


def _options_in(text: str) -> set[str]:
    """Options that start a line of a help text."""
    return set(re.findall(r"^ +(?:-\w,)?(--[a-z-]+)", text, re.MULTILINE))


def test_help_lists_the_commands_and_exit_codes(veldt):
    done = veldt("--help")
    assert (done.code, done.err) == (0, "")
    assert re.findall(r"^  ([a-z]+) {4,}", done.out, re.MULTILINE) == COMMANDS.split(", ")
    assert "0 done, 1 failed, 2 bad usage or config, 3 some inputs rejected, 75 try again later" in done.out


@pytest.mark.parametrize("command", OPTIONS)
def test_help_of_a_command_lists_its_options(veldt, command):
    done = veldt(command, "--help")
    assert (done.code, done.err) == (0, "")
    assert _options_in(done.out) == COMMON | OPTIONS[command]


def test_help_is_a_command_too(veldt):
    assert veldt("help") == veldt("--help")
    for command in OPTIONS:
        assert veldt("help", command) == veldt(command, "--help")


@pytest.mark.parametrize("option", ["--version", "-V"])
def test_version(veldt, option):
    done = veldt(option)
    assert (done.code, done.err) == (0, "")
    assert re.fullmatch(r"\d+\.\d+\.\d+\n", done.out)


USAGE_FAULTS = {
    "no command": ([], f"no command; expected one of {COMMANDS}; see veldt --help"),
    "unknown command": (["evaporate"], f'unknown command "evaporate"; expected one of {COMMANDS}'),
    "misspelt command": (
        ["genrate", "config.json"],
        f'unknown command "genrate"; expected one of {COMMANDS}; did you mean "generate"?',
    ),
    "option without a command": (["--out", "x"], "option --out before a command; see veldt --help"),
    "unknown option": (
        ["generate", "config.json", "--out", "x", "--sead"],
        "unknown option --sead; did you mean --shard?; see veldt generate --help",
    ),
    "misspelt option that is required": (
        ["generate", "config.json", "--uot", "x"],
        "unknown option --uot; did you mean --out?; see veldt generate --help",
    ),
    "argument as an option": (
        ["generate", "--config", "config.json", "--out", "x"],
        "unknown option --config; did you mean config, without --?; see veldt generate --help",
    ),
    "option like no other": (
        ["generate", "config.json", "--out=x", "--colour=red"],
        "unknown option --colour; see veldt generate --help",
    ),
    "too many words": (
        ["doctor", "config.json"],
        "The following argument was not expected: config.json; see veldt doctor --help",
    ),
    "help about nothing we have": (
        ["help", "evaporate"],
        f'unknown command "evaporate"; expected one of {COMMANDS}',
    ),
    "no config": (["generate", "--out", "x"], "config or --plan is required; see veldt generate --help"),
    "no output folder": (["render", "config.json"], "--out is required; see veldt render --help"),
    "no passes": (["convert", "--out", "x"], "passes is required; see veldt convert --help"),
    "unknown way to show progress": (
        ["doctor", "--progress", "loud"],
        "--progress: loud not in {auto,plain,json,none}; see veldt doctor --help",
    ),
    "negative threads": (
        ["doctor", "--threads", "-1"],
        "--threads: Value -1 not in range {range}; see veldt doctor --help",
    ),
    "a number that is none": (
        ["radiance", "--temperature-k", "300,warm"],
        "Could not convert: --temperature-k = 300,warm; see veldt radiance --help",
    ),
    "options that exclude each other": (
        ["radiance", "--temperature-k", "300", "--radiance", "50"],
        "--temperature-k excludes --radiance; see veldt radiance --help",
    ),
}


@pytest.mark.parametrize("name", USAGE_FAULTS)
def test_usage_fault(veldt, name):
    arguments, message = USAGE_FAULTS[name]
    done = veldt(*arguments)
    bounds = "[0 - 1024]" if "[0 - 1024]" in done.err else "0 to 1024"  # as the version of CLI11 has it
    assert (done.code, done.out, done.err) == (2, "", f"veldt: {message.replace('{range}', bounds)}\n")
    assert not list(veldt.folder.iterdir())
