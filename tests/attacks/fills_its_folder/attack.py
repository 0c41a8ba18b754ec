import time

for n in range(14):
    with open(f"file{n}", "wb") as file:
        file.write(b"x" * 1_000_000)
time.sleep(0.5)
print("written")
