"""`bench --suite heat`: speed and error of the heat balance."""


def test_the_heat_balance_is_measured(veldt):
    """Errors do not depend on the machine; they are those of ACCURACY.md and DECISIONS.md, with a margin for changes
    of properties."""
    done = veldt("bench", "--suite", "heat", "--json", "--quiet")
    rows = {}
    for row in done.json()["rows"]:
        rows.setdefault(row["group"], {})[row["name"]] = row["figures"]
    columns = rows["day of a column, winter"]
    assert columns["soil, 144 steps, layers x 1.2"]["night rms mK"] < 100
    finer, coarser = (
        columns[f"soil, {steps}"]["day rms mK"]
        for steps in ("576 steps, 2 mm x 1.2", "72 steps, layers x 1.2")
    )
    assert 0 < finer < 0.3 * coarser
    assert rows["tables of a day"]["all materials"]["columns"] > 500
    looked_up = rows["look-up against the balance"]
    assert looked_up["water"]["03h rms mK"] < 60 and looked_up["soil"]["03h rms mK"] < 400
    assert len(rows["frame, 640 x 512"]) == 3
    assert all(figures["ms"] > 0 for figures in rows["frame, 640 x 512"].values())
