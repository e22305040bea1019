"""Answers the points of a scene, or in ray mode its rays, with different settings."""
import os
import subprocess
import threading
from array import array

from .colors import LUMENS_PER_WATT
from .program import Fault, cpu_seconds, program_beside, start

AT_ONCE = 1 << 16  # bytes


class Setting:
    """The words of a setting with those of the command line, and what rsphere says to them. estimates: whether its answers have errors
    that it needs itself; those of rays have no others, because -oe would change the answers."""

    def __init__(self, words, settings):
        self.words, self.sphere_mode = words, settings.sphere_mode
        self.first, self.settings = int(settings.number("-Sr")), settings
        self.estimates = settings.number("-Sa") > 0
        self.states_errors = self.sphere_mode or self.estimates


class Trials:
    """records: array of per_record numbers each."""

    def __init__(self, scene, records, per_record, messages):
        self.scene, self.records, self.messages = scene, records, messages
        self.count = len(records) // per_record
        # Starts the threads of a run before its time is taken. The ray has no direction, so that nothing is traced, nor is light
        # interpolated; of points there is nothing alike, and what they share (Transport) is not part of their time.
        self.first = records[:3] if per_record == 3 else array("d", [0] * 6)

    def run(self, setting, rotation, errors, timed, trial, answered=lambda count: None):
        """Answers all points once, with this rotation, and adds the answers to the trial. errors: also adds the estimated errors.
        timed: includes these answers in the means of time and directions. answered: called with the number of answered points, while
        they are. If it does not end, nothing is added."""
        letters = "v" + ("e" if errors else "") + ("k" if setting.sphere_mode else "")
        child = start([program_beside("rsphere"), *setting.words, "-Sr", str(rotation), "-h+", "-pY", "-fdd", "-o" + letters, *self.scene],
                      stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        try:
            setup, seconds, numbers = self.answers(child, len(letters), answered)
            self.messages.of_rsphere(child.stderr.read(), of_rays=not setting.sphere_mode)
        finally:
            child.kill()
            child.wait()
        rows = [numbers[i:i + len(letters)] for i in range(0, len(numbers), len(letters))]
        trial.values += [row[0] / LUMENS_PER_WATT for row in rows]
        if errors:
            trial.estimates += [row[1] / LUMENS_PER_WATT for row in rows]
        if timed:
            before, trial.timed = trial.timed, trial.timed + self.count
            trial.seconds = (trial.seconds * before + seconds) / trial.timed
            if setting.sphere_mode:
                trial.directions = (trial.directions * before + sum(row[-1] for row in rows)) / trial.timed
            trial.setup_seconds = max(trial.setup_seconds, setup)

    def answers(self, child, per_answer, answered):
        """CPU time before the first record and for all of them, and the numbers that a program answers. It has read the scene when it
        writes its header, and then waits for records."""
        output, each = child.stdout.fileno(), 8 * per_answer
        wanted, data = each * self.count, b""
        while b"\n\n" not in data:
            data += self.next_of(child, output)
        data = data.split(b"\n\n", 1)[1]
        feed(child.stdin, self.first)
        while len(data) < each:
            data += self.next_of(child, output)
        setup, data = cpu_seconds(child.pid), data[each:]
        # In a thread of its own: the program may write before it has read all. It waits for more until its time is read.
        feeder = threading.Thread(target=feed, args=(child.stdin, self.records), daemon=True)
        feeder.start()
        while len(data) < wanted:
            data += self.next_of(child, output)
            answered(len(data) // each)
        seconds = cpu_seconds(child.pid) - setup
        feeder.join()
        child.stdin.close()
        numbers = array("d")
        numbers.frombytes(data[:wanted])
        return setup, seconds, numbers

    def next_of(self, child, output):
        data = os.read(output, AT_ONCE)
        if not data:
            self.messages.of_rsphere(child.stderr.read())
            raise Fault(f"{child.args[0]} ends with status {child.wait()}", "system")
        return data


def feed(stream, records):
    try:
        stream.write(records.tobytes())
        stream.flush()
    except BrokenPipeError:
        pass  # next_of() tells why
