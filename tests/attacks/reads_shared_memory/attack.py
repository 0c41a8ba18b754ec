import os

print(open("/dev/shm/" + os.environ["SOCKET"]).read())
