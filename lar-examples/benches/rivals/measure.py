"""Time and memory of one operation, for the programs that compare libraries."""

import statistics
import time


def kilobytes(field):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(field))


def measure(operation, seconds=0.0, prepare=tuple):
    """Runs the operation once, and again until some seconds have passed; what the last run returns, and the costs:
    medians of the times, without the first run, in memory touched for the first time, when there are several, and the
    bytes that this added to the process at its peak. What `prepare` returns is passed to each run, and takes no part in
    the times."""
    arguments = prepare()
    with open("/proc/self/clear_refs", "w") as refs:
        refs.write("5")
    before, memory = kilobytes("VmRSS:"), None
    cpu, wall, start = [], [], time.perf_counter()
    while True:
        since, cpu_since = time.perf_counter(), time.process_time()
        result = operation(*arguments)
        cpu.append(time.process_time() - cpu_since)
        wall.append(time.perf_counter() - since)
        memory = memory or 1024 * (kilobytes("VmHWM:") - before)
        if time.perf_counter() - start >= seconds:
            times = {"cpu": median(cpu), "wall": median(wall)}
            return result, {**times, "memory": memory}
        arguments = prepare()


def median(values):
    return statistics.median(values[1:] or values)
