import os
import socket

service = socket.socket(socket.AF_UNIX)
service.connect(os.environ["SECRET"] + ".socket")
print("connected")
