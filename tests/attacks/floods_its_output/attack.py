for _ in range(2000):
    print("x" * 1000)
print("end")
