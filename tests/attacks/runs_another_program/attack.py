import os
import subprocess

subprocess.run([os.environ["PROGRAM"]], check=True)
