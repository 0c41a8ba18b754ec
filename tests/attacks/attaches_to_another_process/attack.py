import ctypes
import os

SEIZE, DETACH = 0x4206, 17
libc = ctypes.CDLL(None)
victim = int(os.environ["VICTIM"])
if libc.ptrace(SEIZE, victim, None, None) == 0:
    print("attached")
