import os

print(open(f"/proc/{os.environ['VICTIM']}/cmdline").read())
