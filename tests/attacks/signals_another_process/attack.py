import os
import signal

os.kill(int(os.environ["VICTIM"]), signal.SIGCONT)
print("sent")
