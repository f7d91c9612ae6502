def fromarray(frame):
    return frame
