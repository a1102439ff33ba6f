#!/usr/bin/env python3
"""What a cycle would take on many ranks: docs/design/distribution.md, "On 1000 ranks".

Counts are those of build/bench_mesh and of `--verbose`; costs a node were measured on one
core; the network is assumed."""

LATENCY = 0.9e-6  # s a message, all of a round one after another
BANDWIDTH = 10.3e9  # bytes a second and rank
COST = {2: 12e-9, 3: 35e-9}  # s a node of the finest level, a cycle with its share of a step
PENCILS = 1.3  # times as much where slices are cut (a step of four ranks, 129³)
WHOLE_COST = {2: 10e-9, 3: 60e-9}  # s a node of the first whole level, a cycle
CYCLES = 2  # a step


def exchanges(dimension, shared, slabs=False):
    """Rounds of messages in a cycle; slabs: ranks have whole slices."""
    if slabs:
        return 3 + 1 / CYCLES + (shared - 1) * 6
    sweep = 2 ** (dimension - 1)
    return sweep + 2 + (shared - 1) * (2 * sweep + 3)


# exchanges of u and w on the finest and on each coarser level that a cycle sends the bytes
# of: pencils by counting rounds, slabs so that --verbose comes out
VOLUME = {False: {3: (4.0, 6.0)}, True: {2: (3.0, 5.0), 3: (2.5, 3.67)}}


def volume(dimension, shared, finest, slabs=False):
    """Bytes sent in a cycle; finest: by an exchange of u and w there."""
    shrink = 0.5 ** (dimension - 1)
    coarse = sum(shrink**level for level in range(1, shared))
    once, again = VOLUME[slabs][dimension]
    return finest * (once + again * coarse)


def predict(name, dimension, nodes, ranks, shared, whole, neighbours, finest, slabs=False):
    alone = COST[dimension] * nodes / ranks
    work = alone if slabs else PENCILS * alone
    again = WHOLE_COST[dimension] * whole
    # of slabs 1.4 messages a neighbour and round were counted
    messages = neighbours * (1.4 if slabs else 1.0)
    rounds = exchanges(dimension, shared, slabs) * messages * LATENCY
    sent = volume(dimension, shared, finest, slabs) / BANDWIDTH
    gather = (ranks - 1) * LATENCY + 16.0 * whole / BANDWIDTH
    depth = (ranks - 1).bit_length()
    reductions = (3.0 + 6.7) / CYCLES * 2 * depth * LATENCY
    total = work + again + rounds + sent + gather + reductions
    parts = (work, again, rounds, sent, gather, reductions)
    row = " | ".join(f"{1e3 * part:.2f}" for part in parts)
    print(f"| {name} | {row} | {100 * alone / total:.0f} % |")


def main():
    print("Volume in a cycle, against what --verbose counts:")
    for name, dimension, shared, finest, counted, slabs in (
        ("65³, 4 pencils", 3, 4, 36448, 230848, False),
        ("129³, 4 pencils", 3, 5, 138336, 857088, False),
        ("257², a slab between two", 2, 5, 4608, 41984, True),
        ("1025², a slab between two", 2, 7, 16896, 145408, True),
        ("65³, a slab between two", 3, 3, 102912, 424448, True),
        ("129³, a slab between two", 3, 4, 335360, 1384192, True),
    ):
        model = volume(dimension, shared, finest, slabs)
        print(f"  {name}: {model:.0f}, {counted} ({100 * model / counted - 100:+.1f} %)")
    print("\n| nodes | own nodes | whole levels | rounds | bytes | gather | reductions |"
          " efficiency |\n|---|---|---|---|---|---|---|---|")
    predict("8193², 64 slabs", 2, 8193**2, 64, 6, 129**2, 2, 131e3, True)
    predict("8193², 256 slabs", 2, 8193**2, 256, 4, 513**2, 2, 131e3, True)
    predict("8193², 1000 slabs", 2, 8193**2, 1000, 2, 2049**2, 2, 131e3, True)
    predict("1025³, 64 pencils", 3, 1025**3, 64, 6, 17**3, 8, 4239e3)
    predict("1025³, 1000 pencils", 3, 1025**3, 1000, 3, 129**3, 8, 1216e3)
    predict("2049³, 1024 pencils", 3, 2049**3, 1024, 5, 65**3, 8, 4266e3)


if __name__ == "__main__":
    main()
