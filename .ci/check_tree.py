"""Checks on the repository's files that no compiler makes: JSON that parses, configs that match their schema,
no paths of a developer's machine, no path that a document leads astray, no number that a locale changes. Standard input
names the files, one a line, relative to the root.

Exit 0 when all is well; 1 with one line a fault, `<file>[:<line>]: <what>; expected <rule>`.
"""

import json
import re
import sys
from pathlib import Path

import jsonschema

sys.path.insert(0, "configs/schema")
from make_editor_schema import editor_schema

CONFIG_SCHEMA = Path("configs/schema/config.schema.json")
# A home or working folder at the start of a path; the look-behind leaves URLs and relative paths alone.
MACHINE_PATH = re.compile(r"(?<![\w./-])/(?:home|root|work|Users)/")

# A path that is joined with, or made of, a value of a JSON document. Text that first goes through a variable is not
# recognized: reviews, and tests/integration/test_openings.py, look for that.
DOCUMENT_VALUE = r"[\w.>-]+(?:\[\"|\.at\(\"|\.value\(\"|\.get<std::string>)"
DOCUMENT_PATH = re.compile(rf"(?:(?<!/)/=? |\bPath[({{])(?:std::string\()?{DOCUMENT_VALUE}")


# Numbers that follow the locale of the process, which may be a host program, and the streams that format them.
LOCALE = re.compile(
    r"\b(?:strto[dfl]+|ato[fil]|std::sto[dfl]+|setlocale|std::to_string\(\d*\.)\b|std::locale::global"
    r"|<iomanip>|<< *(?:std::setprecision|std::fixed)"
)


def json_faults(path: Path) -> list[str]:
    """One line if the file is not JSON; a schema is also checked as a schema, a config against its schema."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except json.JSONDecodeError as error:
        return [f"{path}:{error.lineno}: {error.msg} at column {error.colno}; expected JSON"]
    if path.name.endswith(".schema.json"):
        return schema_faults(path, document)
    if path.parent == CONFIG_SCHEMA.parent.parent:
        return config_faults(path, document)
    return []


def schema_faults(path: Path, schema: dict) -> list[str]:
    """One line if a JSON Schema breaks the rules for schemas."""
    try:
        jsonschema.Draft202012Validator.check_schema(schema)
    except jsonschema.SchemaError as error:
        return [f"{path}: {error.json_path}: {error.message}; expected a JSON Schema of draft 2020-12"]
    return []


def config_faults(path: Path, config: dict) -> list[str]:
    """One line for each place where a config departs from the schema it names, or else that for editors."""
    schema = path.parent / config.get("$schema", "schema/editor.schema.json")
    if schema.name == "editor.schema.json":  # which builds make
        rules = editor_schema(json.loads(CONFIG_SCHEMA.read_text(encoding="utf-8")))
    else:
        rules = json.loads(schema.read_text(encoding="utf-8"))
    return [
        f"{path}: {error.json_path}: {error.message}; expected what {schema} says"
        for error in jsonschema.Draft202012Validator(rules).iter_errors(config)
    ]


def machine_path_faults(path: Path) -> list[str]:
    """One line for each line of text that names a folder of a developer's machine; binaries are skipped."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        return []
    return [
        f"{path}:{number}: a path of a machine; expected a path relative to the repository"
        for number, line in enumerate(lines, start=1)
        if MACHINE_PATH.search(line)
    ]


def document_path_faults(path: Path) -> list[str]:
    """One line for each line of C++ in which a document names a file without any check."""
    lines = enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
    return [
        f"{path}:{number}: a path with text of a document; expected a RelativeName"
        for number, line in lines
        if DOCUMENT_PATH.search(line)
    ]


def locale_faults(path: Path) -> list[str]:
    """One line for each line of C++ that reads or writes numbers as the locale has them."""
    lines = enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
    return [
        f"{path}:{number}: what follows the locale; expected number_in(), std::from_chars or {{fmt}}"
        for number, line in lines
        if LOCALE.search(line.split("//")[0])
    ]


def file_faults(path: Path) -> list[str]:
    """All faults of one file."""
    faults = machine_path_faults(path)
    if path.suffix in (".cpp", ".h") and path.stat().st_size == 0:
        faults.append(f"{path}: empty; expected code")
    if path.suffix == ".json":
        faults += json_faults(path)
    if path.suffix in (".cpp", ".h") and path.parts[0] in ("thermal_core", "cli"):
        faults += document_path_faults(path) + locale_faults(path)
    return faults


def main() -> int:
    """Checks every file named on standard input and prints what is wrong with them."""
    paths = [Path(line) for line in sys.stdin.read().splitlines()]
    faults = [fault for path in paths for fault in file_faults(path)]
    print("\n".join(faults) or f"{len(paths)} files are sound")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
