import time

memory = bytearray(b"x") * (400 << 20)
time.sleep(0.5)
print("held", memory[-1])
