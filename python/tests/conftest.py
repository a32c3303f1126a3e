"""What holds for all tests."""

import signal

# a shell's background jobs ignore Ctrl+C, and what they start does too; the tests of Ctrl+C send it to what they start
signal.signal(signal.SIGINT, signal.default_int_handler)
