"""Reads what Lore writes: runs, lineages, knowledge bases, traces, campaigns.

    import lore

    run = lore.Run("runs/s1")
    run.progress()["best_balls"]                        # numpy arrays; .frame() makes a pandas DataFrame
    run.lineage().ancestors()                           # from the best robot to its founder
    lore.KnowledgeBase("kb1.lorekb").values             # mapped, not copied
    lore.Campaign("runs/small").progress().frame()      # a row a treatment, run and generation

A file that is there but cannot be read raises lore.Damaged, one that is not there FileNotFoundError. Lineages are read
through the program lore-kb, found in the directory LORE_BIN where it is set, else on PATH. lore.plot draws figures with
matplotlib.
"""
from .campaign import Campaign
from .channels import BINARY, CHANNELS, CONTINUOUS, EFFECTORS, SENSORS
from .checksum import checksum_text, xxh3_64
from .errors import Damaged
from .individuals import Genome, Individual, Individuals, Lineage
from .knowledge import Contrast, Credit, KnowledgeBase, Returns
from .report import SOURCE, Report, Scene, WorldScene
from .run import Manifest, Run, read_manifest, read_progress
from .table import Table, read_table
from .trace import Trace, read_trace

__version__ = "1.0.0"

__all__ = [
    "BINARY", "CHANNELS", "CONTINUOUS", "EFFECTORS", "SENSORS", "SOURCE",
    "Campaign", "Contrast", "Credit", "Damaged", "Genome", "Individual", "Individuals", "KnowledgeBase", "Lineage",
    "Manifest", "Report", "Returns", "Run", "Scene", "Table", "Trace", "WorldScene",
    "checksum_text", "read_manifest", "read_progress", "read_table", "read_trace", "xxh3_64",
]  # fmt: skip
