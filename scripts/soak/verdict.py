"""What the rows of a soak have to show."""

LARGEST_GROWTH = 1.05    # of the last third over the middle third
SHORTEST = 30            # minutes that the memory is judged from: caches fill before
LARGEST_LATE = 0.001     # share of the cycles
LARGEST_LOST = 0.001     # share of the requests (doc/services.md)
LARGEST_FAILED = 0.2     # share of the comparisons that found no quiet sample, or whose scene changed meanwhile
LARGEST_BAGS = 1300.0    # MiB: two bags of four pieces of 128, and of each a fifth that is being written
PROGRAMS = ("node", "bridge", "guard")


def verdict(rows):
    """@param rows dictionaries by column, one a minute @return (line, whether it is as it should be) for each demand"""
    third = max(1, len(rows) // 3)
    lines = []
    for program in PROGRAMS:
        column = [float(row[program + "_mb"]) for row in rows]
        middle, last = max(column[-2 * third:-third] or column[:third]), max(column[-third:])
        lines.append(("memory of the %s: at most %.1f MiB in the last third, %.1f in the one before (%+.1f %%; allowed: %+.0f %%)"
                      % (program, last, middle, 100.0 * (last / middle - 1.0) if middle else 0.0, 100.0 * (LARGEST_GROWTH - 1.0)),
                      0.0 < last and (last <= LARGEST_GROWTH * middle or len(rows) < SHORTEST)))
    total = {name: sum(int(row[name]) for row in rows) for name in (
        "cycles", "late", "failed", "messages", "compared", "different", "lists", "lists_different", "failed_comparisons",
        "refused", "taken", "lost", "ids", "ids_lost", "errors", "edits", "nonsense")}
    share = total["late"] / total["cycles"] if total["cycles"] else 1.0
    lines.append(("late: %d of %d cycles (%.4f %%; allowed: %.1f %%), %d failed" % (
        total["late"], total["cycles"], 100.0 * share, 100.0 * LARGEST_LATE, total["failed"]),
        share <= LARGEST_LATE and total["failed"] == 0))
    lines.append(("messages: %d came of %d cycles" % (total["messages"], total["cycles"]),
                  total["messages"] >= (1.0 - LARGEST_LATE) * total["cycles"] - 100))
    largest = max(float(row["largest_difference"]) for row in rows)
    lines.append(("answers: %d compared with a fresh node's, %d different (equal: at most %.2g m apart)" % (
        total["compared"], total["different"], largest), total["compared"] > 0 and total["different"] == 0))
    lines.append(("lists of niches: %d compared, %d different" % (total["lists"], total["lists_different"]),
                  total["lists"] > 0 and total["lists_different"] == 0))
    lines.append(("comparisons without a sample: %d of %d" % (total["failed_comparisons"], len(rows)),
                  total["failed_comparisons"] <= LARGEST_FAILED * len(rows)))
    lines.append(("ids: %d niches began, %d lost their id" % (total["ids"], total["ids_lost"]), total["ids_lost"] == 0))
    lines.append(("requests: %d good ones, %d refused; %d bad ones, %d taken; %d without an answer" % (
        total["edits"], total["refused"], total["nonsense"], total["taken"], total["lost"]),
        total["edits"] > 0 and total["refused"] == total["taken"] == 0 and total["lost"] <= LARGEST_LOST * total["edits"] + 1))
    bags = max(float(row["bags_mb"]) for row in rows)
    lines.append(("bags: at most %.0f MiB (allowed: %.0f)" % (bags, LARGEST_BAGS), 0.0 < bags <= LARGEST_BAGS))
    lines.append(("errors in rosout: %d; restarts: %s" % (total["errors"], rows[-1]["restarts"]),
                  total["errors"] == 0 and int(rows[-1]["restarts"]) == 0))
    return lines
