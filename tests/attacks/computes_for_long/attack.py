import time

while time.process_time() < 5:
    pass
print("computed")
