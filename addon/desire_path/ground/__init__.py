"""The ground and what stands on it: soil, plants, the simulation that presses them, the maps it leaves."""
