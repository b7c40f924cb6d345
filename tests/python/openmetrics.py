"""A strict reader of metrics: of Prometheus' text format 0.0.4, and of OpenMetrics 1.0, as far as zrasterd writes them. ValueError says
what is wrong in which line."""
import math
import re

ENDINGS = {"counter": ("_total",), "gauge": ("",), "histogram": ("_bucket", "_sum", "_count"), "info": ("_info",)}
NAME = r"[a-zA-Z_:][a-zA-Z0-9_:]*"
LABEL = re.compile(r'([a-zA-Z_][a-zA-Z0-9_]*)="((?:[^"\\\n]|\\[\\"n])*)"(,|$)')
UNITS = ("seconds", "bytes")


class Family:
    """`samples`: {(name, labels): value} in the order of the text, where labels are ((name, text), ...)."""

    def __init__(self, name):
        self.name, self.type, self.help, self.unit, self.samples = name, None, None, None, {}

    def sum(self, **labels):
        """Returns the sum of all samples with these labels."""
        return sum(value for (_, has), value in self.samples.items() if labels.items() <= dict(has).items())


def read_labels(text):
    labels, at = [], 0
    while at < len(text):
        found = LABEL.match(text, at)
        if not found or (found[3] and found.end() == len(text)):
            raise ValueError(f"labels: {text}")
        labels.append((found[1], re.sub(r"\\(.)", lambda m: "\n" if m[1] == "n" else m[1], found[2])))
        at = found.end()
    if len(dict(labels)) < len(labels):
        raise ValueError(f"a label twice: {text}")
    return tuple(labels)


def check_histogram(family):
    """Buckets ascend, and the last one is +Inf and equals the count; each has a sum."""
    rows = {}
    for (name, labels), value in family.samples.items():
        key = tuple(one for one in labels if one[0] != "le")
        row = rows.setdefault(key, {"buckets": []})
        ending = name[len(family.name):]
        if ending == "_bucket":
            row["buckets"].append((float(dict(labels)["le"]), value))
        else:
            row[ending] = value
    for key, row in rows.items():
        where = f"{family.name}{dict(key)}"
        bounds, counts = zip(*row["buckets"]) if row["buckets"] else ((), ())
        if list(bounds) != sorted(set(bounds)) or not bounds or bounds[-1] != math.inf:
            raise ValueError(f"{where}: bounds {bounds}")
        if list(counts) != sorted(counts):
            raise ValueError(f"{where}: buckets are not cumulative: {counts}")
        if counts[-1] != row.get("_count") or "_sum" not in row:
            raise ValueError(f"{where}: +Inf {counts[-1]}, count {row.get('_count')}, sum {row.get('_sum')}")


def parse(text, is_open=False):
    """Returns {name: Family}; the names are those of lines # TYPE."""
    if not text.endswith("\n") or (is_open and not text.endswith("# EOF\n")):
        raise ValueError(f"the end: {text[-40:]!r}")
    families, family = {}, None
    lines = text.split("\n")[:-2 if is_open else -1]
    for number, line in enumerate(lines, 1):
        try:
            head = re.fullmatch(rf"# (HELP|TYPE|UNIT) ({NAME}) (.+)", line)
            if head:
                key, name, value = head[1].lower(), head[2], head[3]
                if family is None or family.name != name:
                    if name in families:
                        raise ValueError("lines of a family are not together")
                    family = families[name] = Family(name)
                if getattr(family, key) is not None or family.samples:
                    raise ValueError(f"{head[1]} twice, or after samples")
                if key == "type" and (value not in ENDINGS or (value == "info" and not is_open)):
                    raise ValueError(f"type {value}")
                if key == "unit" and not (is_open and name.endswith("_" + value)):
                    raise ValueError(f"unit {value}")
                setattr(family, key, value)
                continue
            sample = re.fullmatch(rf"({NAME})(?:\{{(.*)\}})? (\S+)", line)
            if not sample:
                raise ValueError("no sample and no # HELP, # TYPE, # UNIT")
            if family is None or family.type is None or family.help is None:
                raise ValueError("a sample before TYPE and HELP")
            name, labels, value = sample[1], read_labels(sample[2] or ""), float(sample[3])
            endings = ENDINGS[family.type] if is_open or family.type == "histogram" else ("",)
            if name not in [family.name + ending for ending in endings]:
                raise ValueError(f"sample {name} of the {family.type} {family.name}")
            if family.type == "counter" and not is_open and not name.endswith("_total"):
                raise ValueError("a counter without _total")
            if is_open and family.unit is None and family.name.rsplit("_", 1)[-1] in UNITS:
                raise ValueError("no # UNIT")
            if (name, labels) in family.samples:
                raise ValueError("the same sample twice")
            if family.type != "gauge" and not (math.isfinite(value) and value >= 0):
                raise ValueError(f"value {value} of a {family.type}")
            if family.type == "info" and value != 1:
                raise ValueError(f"value {value} of an info")
            le = dict(labels).get("le")
            if (le is not None) != name.endswith("_bucket") or (is_open and le and not re.fullmatch(r"\+Inf|\d+\.\d+|\d(\.\d+)?e[+-]\d+", le)):
                raise ValueError(f"le {le}")
            family.samples[name, labels] = value
        except ValueError as error:
            raise ValueError(f"line {number}: {error}: {line}") from None
    for family in families.values():
        if family.type is None or family.help is None:
            raise ValueError(f"{family.name}: no TYPE or no HELP")
        if family.type == "histogram":
            check_histogram(family)
    return families
