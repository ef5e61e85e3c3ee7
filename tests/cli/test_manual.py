"""Manual pages and completions, which the build makes from the table of commands."""

import gzip
import os
import pty
import re
import shutil
import subprocess

import pytest

from processes import PATIENCE_S
from program import PROGRAM

SHARE = PROGRAM.parents[1] / "share"
PAGES = SHARE / "man" / "man1"
BASH = SHARE / "bash-completion" / "completions" / "veldt"
ZSH = SHARE / "zsh" / "_veldt"
FISH = SHARE / "fish" / "vendor_completions.d" / "veldt.fish"
SECTIONS = ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "ENVIRONMENT", "FILES", "SEE ALSO"]


@pytest.fixture(name="helps", scope="module")
def _helps(tmp_path_factory) -> dict[str, str]:
    """The help of each command."""

    def text(*arguments: str) -> str:
        done = subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True, check=True)
        return done.stdout

    folder = tmp_path_factory.mktemp("helps")
    commands = re.findall(r"^  ([a-z]+) {4,}", text("--help"), re.MULTILINE)
    return {command: text(command, "--help") for command in commands}


def _options(text: str) -> set[str]:
    """Options that a help text lists."""
    return set(re.findall(r"^ +(?:-\w,)?(--[a-z-]+)", text, re.MULTILINE))


def _choices(text: str) -> dict[str, list[str]]:
    """The fixed choices that a help text lists, by option or argument."""
    found = re.findall(r"^ +(\S+) [A-Z]+:\{(.*?)\}", text, re.MULTILINE)
    return {name: re.split(r",(?! )", choices) for name, choices in found}


def _source(page: str) -> str:
    return gzip.decompress((PAGES / f"{page}.1.gz").read_bytes()).decode("ascii")


def _run(*command, **options) -> subprocess.CompletedProcess:
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=PATIENCE_S, **options)


def _need(program: str) -> None:
    if shutil.which(program) is None:
        pytest.skip(f"{program} is not installed")


def _read(page: str) -> str:
    """A page as somebody reads it in a terminal of 100 columns, without line breaks."""
    done = _run(
        "man",
        "-P",
        "cat",
        "-l",
        PAGES / f"{page}.1.gz",
        env=os.environ | {"MANWIDTH": "100", "LC_ALL": "C.UTF-8"},
    )
    return " ".join(done.stdout.split())


# --- pages ------------------------------------------------------------------------------------------------------------


def test_every_command_has_a_page(helps):
    pages = sorted(file.name for file in PAGES.iterdir())
    assert pages == sorted(["veldt.1.gz", *(f"veldt-{command}.1.gz" for command in helps)])


def test_pages_have_the_sections_that_readers_look_for(helps):
    for page in ["veldt", *(f"veldt-{command}" for command in helps)]:
        found = re.findall(r"^\.SH (.*)$", _source(page), re.MULTILINE)
        assert [name for name in found if name not in ("ARGUMENTS", "COMMANDS", "EXAMPLES")] == SECTIONS, page


def test_every_command_has_an_example_with_its_own_options(helps):
    for command, text in helps.items():
        examples = re.findall(r"^Example: (.*)$", text, re.MULTILINE)
        assert examples
        for example in examples:
            assert example.startswith(f"veldt {command} ") and set(
                re.findall("--[a-z-]+", example)
            ) <= _options(text)
            assert f".PP\n\\fB{example}\\fR\n".replace("-", "\\-") in _source(f"veldt-{command}")


def test_pages_name_every_option_and_choice(helps):
    for command, text in helps.items():
        source = _source(f"veldt-{command}").replace("\\-", "-")
        headings = re.findall(r"^\.TP\n(.*)$", source, re.MULTILINE)
        named = {name for line in headings for name in re.findall(r"\\fB(--[a-z-]+)\\fR", line)}
        assert named == _options(text)
        for name, choices in _choices(text).items():
            assert "One of " + ", ".join(f"\\fB{choice}\\fR" for choice in choices) + "." in source, name


def test_a_page_reads_well():
    _need("man")
    text = _read("veldt-generate")
    assert "veldt generate [config] --out DIR [OPTIONS]" in text
    assert "--jobs INT Blender processes to run at once, one clip each;" in text
    assert "(embree uses all threads anyway). From 1 to 64. Default: 1." in text
    assert "--clips ID,… Only these clips. Takes several values." in text
    assert "75 try again later" in text
    assert (
        "If a run is interrupted, the same command continues it, and the pixels are the same as without the "
        in text
    )
    assert "VELDT_HOME Folder with assets" in text
    assert "veldt(1), veldt-plan(1), veldt-convert(1)" in text


def test_man_and_groff_have_no_warning(helps):
    _need("man")
    for page in ["veldt", *(f"veldt-{command}" for command in helps)]:
        file = PAGES / f"{page}.1.gz"
        warned = _run(
            "man",
            "--warnings",
            "-E",
            "UTF-8",
            "-l",
            "-Tutf8",
            "-Z",
            file,
            env=os.environ | {"MANWIDTH": "80"},
        )
        assert warned.stderr == "", page
        assert _run("groff", "-man", "-Tutf8", "-ww", input=_source(page)).stderr == "", page


def test_the_name_section_can_be_indexed():
    """By lexgrog, as `apropos` and `whatis` need it."""
    _need("lexgrog")
    done = _run("lexgrog", PAGES / "veldt-radiance.1.gz")
    assert done.stdout.endswith(
        '"veldt-radiance - in-band radiance of a temperature, or temperature of a radiance"\n'
    )


# --- bash -------------------------------------------------------------------------------------------------------------


def _bash(*words: str) -> list[str]:
    """What bash offers for the last of the words after the program's name."""
    script = (
        'source "$1"; shift; COMP_WORDS=(veldt "$@") COMP_CWORD=$#; _veldt; printf "%s\\n" "${COMPREPLY[@]}"'
    )
    return _run("bash", "-c", script, "bash", BASH, *words).stdout.split("\n")[:-1]


def test_bash_completes_commands(helps):
    assert _bash("") == [*helps, "help", "-h", "--help", "-V", "--version"]
    assert _bash("he") == ["heat", "help"]
    assert _bash("help", "e") == ["export", "evaluate"]


def test_bash_completes_every_option_and_choice(helps):
    for command, text in helps.items():
        assert set(_bash(command, "--")) == _options(text)
        for name, choices in _choices(text).items():
            quoted = [choice.replace(" ", "\\ ").replace(",", "\\,") for choice in choices]
            assert (
                _bash(command, name, "") == quoted if name.startswith("-") else _bash(command, "") == choices
            )


@pytest.mark.parametrize(
    "words, offered",
    [
        (["generate", "--engine", "e"], ["embree"]),
        (["generate", "--engine", "="], ["auto", "blender", "embree"]),  # bash splits --engine=
        (["generate", "--engine", "=", "e"], ["embree"]),
        (["generate", "config.json", "--en"], ["--engine"]),
        (["cluster", "--nodes", "4", "s"], ["slurm"]),
        (["cluster", "slurm", ""], [""]),
        (["generate", "--out", ""], [""]),  # nothing: bash then offers files
        (["generate", "co"], [""]),
        (["evaporate", "--"], [""]),
    ],
)
def test_bash_offers(words, offered):
    assert _bash(*words) == offered


# --- as typed ---------------------------------------------------------------------------------------------------------

# Keys, and the words that the shell then hands to the program.
TYPED = "veldt gene\tconfi\t--engi\tem\t--out out\r"
WORDS = "<generate><config.json><--engine><embree><--out><out>"


def _typed(shell: list[str], folder, keys: str) -> str:
    """What an interactive shell prints when somebody types `keys`."""
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.execvpe(shell[0], shell, os.environ | {"TERM": "dumb", "HOME": str(folder)})
    output = b""
    try:
        for line in [*keys.splitlines(keepends=True), "exit\r"]:
            os.write(terminal, line.encode())
        while piece := os.read(terminal, 4096):
            output += piece
    except OSError:  # the shell has ended
        pass
    finally:
        os.close(terminal)
        os.waitpid(child, 0)
    return output.decode(errors="replace")


def test_tab_completes_in_bash(tmp_path):
    (tmp_path / "config.json").touch()
    prepare = f"source {BASH}; veldt() {{ printf '<%s>' \"$@\"; }}\r"
    assert WORDS in _typed(["bash", "--norc", "-i"], tmp_path, prepare + TYPED)


def test_tab_completes_in_zsh(tmp_path):
    _need("zsh")
    (tmp_path / "config.json").touch()
    prepare = (
        f"fpath=({ZSH.parent} $fpath); autoload -U compinit; compinit -u -D; "
        "zstyle ':completion:*' insert-tab false; "  # however fast keys come, a Tab completes
        "veldt() { printf '<%s>' \"$@\" }\r"
    )
    assert WORDS.replace("--engine><", "--engine=") in _typed(["zsh", "-f", "-i"], tmp_path, prepare + TYPED)


def _fish(line: str, folder) -> list[str]:
    """What fish offers at the end of a command line."""
    script = f"source {FISH}; complete -C '{line}'"
    out = _run("fish", "--no-config", "-c", script, cwd=folder).stdout
    return [offer.split("\t")[0] for offer in out.splitlines()]


def test_fish_completes(helps, tmp_path):
    _need("fish")
    (tmp_path / "config.json").touch()
    assert set(_fish("veldt ", tmp_path)) == {*helps, "help"}
    assert _fish("veldt generate --engine ", tmp_path) == ["auto", "blender", "embree"]
    assert _fish("veldt generate con", tmp_path) == ["config.json"]
    assert _fish("veldt cluster s", tmp_path) == ["slurm"]
    for command, text in helps.items():
        assert set(_fish(f"veldt {command} --", tmp_path)) == _options(text)
        for name, choices in _choices(text).items():
            if name.startswith("--"):
                offered = _fish(f"veldt {command} {name} ", tmp_path)
                assert {offer.replace("\\", "") for offer in offered} == set(choices)
