#!/usr/bin/env python3
"""What a cycle would take on many ranks: docs/design/distribution.md, "On 1000 ranks".

Counts are those of build/bench_mesh (from the Morton curve) and of `--verbose`; costs a
node were measured on one core; the network is assumed."""

LATENCY = 0.9e-6  # s a message, all of a round one after another
BANDWIDTH = 10.3e9  # bytes a second and rank
COST = {2: 12e-9, 3: 35e-9}  # s a node of the finest level, a cycle with its share of a step
BOXES = 1.7  # times as much on boxes that are no whole slices (user CPU of four ranks)
WHOLE_COST = {2: 10e-9, 3: 60e-9}  # s a node of the first whole level, a cycle
CYCLES = 2  # a step


def exchanges(dimension, shared, slabs=False):
    """Rounds of messages in a cycle; slabs: ranks have whole slices."""
    if slabs:
        return 3 + 1 / CYCLES + (shared - 1) * 6
    sweep = 2**dimension
    return sweep + 2 + (shared - 1) * (2 * sweep + 3)


# exchanges of u and w on the finest and on each coarser level that a cycle sends the bytes
# of: boxes by counting rounds, slabs so that --verbose comes out
VOLUME = {False: {2: (4.0, 6.0), 3: (4.0, 6.0)}, True: {2: (3.0, 5.0), 3: (2.5, 3.67)}}


def volume(dimension, shared, finest, slabs=False):
    """Bytes sent in a cycle; finest: by an exchange of u and w there."""
    shrink = 0.5 ** (dimension - 1)
    coarse = sum(shrink**level for level in range(1, shared))
    once, again = VOLUME[slabs][dimension]
    return finest * (once + again * coarse)


def predict(name, dimension, nodes, ranks, shared, whole, neighbours, finest, slabs=False):
    alone = COST[dimension] * nodes / ranks
    work = alone if slabs else BOXES * alone
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
        ("257², 4 ranks in leaves", 2, 6, 2080, 21184, False),
        ("1025², 4 ranks in leaves", 2, 8, 8224, 83008, False),
        ("65³, 4 ranks in leaves", 3, 4, 36448, 230848, False),
        ("129³, 4 ranks in leaves", 3, 5, 138336, 857088, False),
        ("257², a slab between two", 2, 5, 4608, 41984, True),
        ("1025², a slab between two", 2, 7, 16896, 145408, True),
        ("65³, a slab between two", 3, 3, 102912, 424448, True),
        ("129³, a slab between two", 3, 4, 335360, 1384192, True),
    ):
        model = volume(dimension, shared, finest, slabs)
        print(f"  {name}: {model:.0f}, {counted} ({100 * model / counted - 100:+.1f} %)")
    print("\n| nodes | own nodes | whole levels | rounds | bytes | gather | reductions |"
          " efficiency |\n|---|---|---|---|---|---|---|---|")
    predict("8193²", 2, 8193**2, 1000, 5, 257**2, 8.4, 14e3)
    predict("8193², patch 16", 2, 8193**2, 1000, 3, 1025**2, 8.4, 15e3)
    predict("32769²", 2, 32769**2, 1000, 7, 257**2, 8.4, 56e3)
    predict("1025³", 3, 1025**3, 1000, 4, 65**3, 26.2, 762e3)
    predict("1025³, patch 16", 3, 1025**3, 1000, 3, 129**3, 26.5, 763e3)
    predict("2049³", 3, 2049**3, 1000, 5, 65**3, 26.2, 3050e3)
    predict("8193², 64 slabs", 2, 8193**2, 64, 6, 129**2, 2, 133e3, True)
    predict("8193², 64 ranks in leaves", 2, 8193**2, 64, 8, 33**2, 8, 33e3)
    predict("1025³, 64 slabs", 3, 1025**3, 64, 3, 129**3, 2, 17.4e6, True)
    predict("1025³, 64 ranks in leaves", 3, 1025**3, 64, 7, 9**3, 26, 3.2e6)


if __name__ == "__main__":
    main()
