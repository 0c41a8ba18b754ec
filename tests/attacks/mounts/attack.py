import ctypes
import os

NEW_USER, NEW_NS = 0x1000_0000, 0x0002_0000
libc = ctypes.CDLL(None)
libc.unshare(NEW_USER | NEW_NS)
os.makedirs("here", exist_ok=True)
if libc.mount(b"none", b"here", b"tmpfs", 0, None) == 0:
    print("mounted")
