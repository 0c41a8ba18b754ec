import os

print("seen" if os.environ["VICTIM"] in os.listdir("/proc") else "hidden")
