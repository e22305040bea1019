"""How far a program is, for who waits at a terminal: one line on standard error, written over, and none in a pipe."""
import sys
import time

TOO_SOON = 1.0  # s: the time left is not known before


class Progress:
    def __init__(self, stream):
        self.stream = stream if stream.isatty() else None
        self.shown = False
        self.begin("")

    def begin(self, name, count=0, seconds=0.0):
        """Of what is done now. count: of parts that are alike; seconds: that it may take, where parts are not counted."""
        self.name, self.count, self.done, self.start = name, count, 0, time.monotonic()
        if name:
            self.show(f"{name}, at most {seconds:.0f} s" if seconds else name)

    def advance(self):
        """One more part is done."""
        self.done += 1
        took = time.monotonic() - self.start
        left = f", {took / self.done * (self.count - self.done):.0f} s left" if took > TOO_SOON else ""
        self.show(f"{self.name}: {self.done} of {self.count}{left}")

    def clear(self):
        """Before what is printed on the same terminal."""
        self.show("")

    def show(self, text):
        if self.stream and (text or self.shown):
            self.stream.write(f"\r\033[K{text}")
            self.stream.flush()
            self.shown = bool(text)


PROGRESS = Progress(sys.stderr)
