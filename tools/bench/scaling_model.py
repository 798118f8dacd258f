"""What a generation costs on any number of ranks, from measurements on one and two: the model of
docs/findings/scaling.md. scaling-report measures, and writes what it says."""

import math

KINDS = ("adhoc", "hamming", "trajectory", "entropy")
POPULATIONS = (50, 100, 200, 400, 800)
BATCHES = (1, 4, 8, 12, 16, 24, 32, 48, 64, 100, 200)
USUAL_POPULATION = 200
LARGE = 2000            # individuals, of which the ranks share distances (src/cluster/distance_farm.cpp)
IN_MATRIX = ("hamming", "trajectory")   # of which ranks measure rows of the matrix; of others, the means of members
LANES = {"v4": 32, "v3": 16, "baseline": 8}   # of a rank
SENDING = 4e-6          # s; assumed: what MPI takes of rank 0 for an individual's two messages
IDEAL = "no delay"
NETWORKS = {IDEAL: (0, 1e12), "1 Gbit/s, 50 us": (50e-6, 1e9), "300 Mbit/s, 50 us": (50e-6, 3e8),
            "100 Mbit/s, 50 us": (50e-6, 1e8), "1 Gbit/s, 2 ms": (2e-3, 1e9)}   # (delay of one way [s], bit/s)
CLUSTERS = {IDEAL: (0, math.inf), "10 Gbit/s, 20 us": (20e-6, 1e10), "1 Gbit/s, 50 us": (50e-6, 1e9)}


class Measured:
    """The measurements, and the constants that are fitted to them."""

    def __init__(self, rows, lanes, processors):
        self.lanes, self.processors = lanes, processors
        self.values = {(series, str(x), quantity): float(value) for series, x, quantity, value in rows}
        self.batch = [(n, self("batch", n, "evaluation")) for n in BATCHES]
        # Least squares of the logarithms: what a multiple of the population does.
        self.distance_exponent = self.exponent("population", POPULATIONS[1:], "distances")
        self.selection_exponent = self.exponent("population", POPULATIONS[1:], "selection")
        self.message = self("message", "genome", "seconds") + self("message", "evaluation", "seconds") + SENDING

    def __call__(self, series, x, quantity):
        return self.values[series, str(x), quantity]

    def mean(self, series, x, quantity):
        return sum(self(series, x, f"{quantity}/{kind}") for kind in KINDS) / len(KINDS)

    def exponent(self, series, xs, quantity):
        points = [(math.log(x), math.log(self.mean(series, x, quantity))) for x in xs]
        mean_x, mean_y = (sum(point[i] for point in points) / len(points) for i in (0, 1))
        return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)

    def in_lanes(self, individuals):
        """Seconds that one rank takes for that many individuals of the usual length; linear between batches."""
        for (n, seconds), (next_n, next_seconds) in zip(self.batch, self.batch[1:]):
            if individuals <= next_n:
                return seconds + (individuals - n) / (next_n - n) * (next_seconds - seconds)
        return self.batch[-1][1] * individuals / self.batch[-1][0]

    def share(self, population, ranks):
        """Individuals of a rank other than rank 0, as in src/cluster/share.h."""
        half_set = self.lanes // 2
        return math.ceil(population / (ranks * half_set)) * half_set

    def evaluating(self, in_all, population, ranks, distances, network):
        """Seconds until all are evaluated, beside which rank 0 measures `distances` [s]. in_all: evaluation of the
        population on one rank [s]."""
        def evaluation(individuals):
            return in_all * self.in_lanes(individuals) / self.in_lanes(population)
        share = self.share(population, ranks)
        others = min(population, share * (ranks - 1))
        beside = others * self.message + distances   # rank 0's
        waves = [min(self.lanes, share - first) for first in range(0, share, self.lanes)]
        latency, bandwidth = network
        transfer = self.transfer(others, bandwidth)
        evaluated, link = 0.0, 0.0
        for wave in waves:
            evaluated += evaluation(wave)
            link = max(link, evaluated) + transfer * wave / share
        last = waves[-1] / share
        of_rank_0 = (evaluation(population - others) if others < population else 0.0) + beside * (1 - last)
        return 2 * latency + max(link, max(evaluated, of_rank_0) + beside * last)

    def transfer(self, individuals, bandwidth):
        """Seconds that their evaluations take a link."""
        return individuals * self("message", "evaluation", "bytes") * 8 / bandwidth

    def generation(self, task, ranks, network=CLUSTERS[IDEAL]):
        """Seconds, of USUAL_POPULATION individuals: the first formula of docs/findings/scaling.md."""
        evaluation, distances, selection, files = (
            self(f"run/{task}", 1, quantity) for quantity in ("evaluation", "distances", "selection", "files"))
        if ranks == 1:
            return evaluation + distances + selection + files
        return self.evaluating(evaluation, USUAL_POPULATION, ranks, distances, network) + selection + files

    def of_large(self, kind, ranks, network=CLUSTERS[IDEAL]):
        """(seconds of a generation, those of them in which all ranks evaluate or measure) of LARGE individuals: the
        second formula of docs/findings/scaling.md."""
        wall, evaluation, distances = (self(f"large/{kind}", 1, name) for name in ("wall", "evaluation", "distances"))
        if ranks == 1:
            return wall, evaluation + distances
        evaluating = self.evaluating(evaluation, LARGE, ranks, 0.0, network)
        shared = evaluation * self.in_lanes(self.share(LARGE, ranks)) / self.in_lanes(LARGE)
        rest = wall - evaluation - distances   # selection, files and what no one accounts for
        pool = 2 * LARGE
        latency, bandwidth = network
        def message(what, quantity):
            return self(f"message/{what}", kind, quantity)
        hop = latency + 2 * pool * message("pool", "bytes") * 8 / bandwidth   # to two others
        handed_on = pool * message("pool", "pack") + int(math.log2(ranks)) * hop + pool * message("pool", "unpack")
        if kind in IN_MATRIX:
            measuring, results = distances / ranks, 1.5 * LARGE ** 2   # those among the survivors are known
            packing, unpacking, size = (message("distances", name) for name in ("pack", "unpack", "bytes"))
        else:   # pairs of two ranks' members are measured twice
            measuring, results = distances * (2 / ranks - 1 / ranks ** 2), pool
            packing, unpacking, size = 0.0, 0.0, 8
        back = results * packing / ranks + latency + (ranks - 1) / ranks * results * (unpacking + size * 8 / bandwidth)
        return evaluating + handed_on + measuring + back + rest, shared + measuring

    def on_nodes(self, ranks, name):
        """Seconds of a generation of the source task (Hamming distances) on nodes that share this machine's processors:
        the third formula of docs/findings/scaling.md."""
        alone = self(f"nodes/{IDEAL}", ranks, "generation")
        latency, bandwidth = NETWORKS[name]
        wave = self.lanes   # of a rank's individuals, which are evaluated together
        first = self("run/source", 1, "evaluation") * self.in_lanes(wave) / self.in_lanes(USUAL_POPULATION)
        evaluated = alone - self("population", USUAL_POPULATION, "distances/hamming") \
            - self("run/source", 1, "selection") - self("run/source", 1, "files")
        others = min(USUAL_POPULATION, self.share(USUAL_POPULATION, ranks) * (ranks - 1))
        last_waves = self.transfer(self.processors * wave, bandwidth)
        return alone + 2 * latency + max(last_waves, first + self.transfer(others, bandwidth) - evaluated)
