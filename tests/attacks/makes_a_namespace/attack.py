import ctypes

NEW_USER = 0x1000_0000
if ctypes.CDLL(None).unshare(NEW_USER) == 0:
    print("made")
