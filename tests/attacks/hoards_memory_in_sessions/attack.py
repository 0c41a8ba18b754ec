import os
import time

for _ in range(4):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            memory = bytearray(b"x") * (100 << 20)
            time.sleep(1.5)
        os._exit(0)
time.sleep(1)
print("held")
