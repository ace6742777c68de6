import matplotlib
from hypothesis import settings

matplotlib.use("Agg")
settings.register_profile("short", max_examples=25, deadline=None, derandomize=True)
settings.load_profile("short")
