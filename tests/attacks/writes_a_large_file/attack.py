with open("large", "wb") as file:
    file.write(b"x" * (6 << 20))
print("written")
