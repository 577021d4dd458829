"""Models spawned into the furniture of a flat are not thrown: a sample of bench/spawns.py."""
import spawns


def test_no_model_is_thrown_out_of_an_overlap() -> None:
    results = spawns.spawns(30)
    worst = max(results, key=lambda result: result.excess)
    assert worst.excess < spawns.FASTEST, worst
