import os

print(open(os.environ["SECRET"]).read())
