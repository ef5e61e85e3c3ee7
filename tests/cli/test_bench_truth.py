"""`bench --suite truth`: the whole chain against an end-to-end truth."""


def _rows_of(veldt, group):
    done = veldt("bench", "--suite", "truth", "--only", group, "--json", "--quiet")
    assert (done.code, done.err) == (0, "")
    rows = done.json()["rows"]
    assert {row["group"] for row in rows} == {group}
    return {row["name"]: row["figures"] for row in rows}


def test_the_truth_is_converged(veldt):
    rows = _rows_of(veldt, "convergence of the truth")
    assert len(rows) == 6
    assert all(figures["worst mK"] < 20 for figures in rows.values())


def test_each_term_has_its_share(veldt):
    """Errors are the same on every machine; the bounds leave room for changes of the chain."""
    rows = _rows_of(veldt, "share of the error")
    sampling = [rows[f"sampling, {n} x {n}"]["rms mK"] for n in (1, 2, 4, 8)]
    assert sampling == sorted(sampling, reverse=True)
    assert sampling[0] > 3 * sampling[2]
    assert rows["band"]["rms mK"] < 50
    assert rows["optics"]["rms mK"] < 100
    assert set(rows["optics"]) == {"rms mK", "worst mK", "signal %", "scatter %"}
    assert rows["bars, smear and lag"]["worst mK"] < 500 < rows["bars, lag by frames"]["worst mK"] / 5


def test_a_person_at_122_m_is_right_by_default(veldt):
    """The defaults of a physical sensor: with Embree adaptive 4 x 4, with Blender 4 x 4."""
    for group in ("sampling, still", "sampling, moving"):
        rows = _rows_of(veldt, group)
        for name in ("4 x 4", "adaptive 4 x 4"):
            assert rows[name]["rms mK"] < 300
            assert abs(rows[name]["signal %"]) < 3 and rows[name]["scatter %"] < 3


def test_an_unknown_group_is_refused(veldt):
    done = veldt("bench", "--suite", "truth", "--only", "nothing")
    assert (done.code, done.out) == (2, "")
    assert "nothing not in {sampling, moving" in done.err
