import os

path = os.path.join(os.path.dirname(os.environ["SECRET"]), "record.json")
open(path, "w").write("forged")
os.remove(path)
print("written")
