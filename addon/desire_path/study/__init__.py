"""Experiments on plants: lanes that are trampled, kinds that are calibrated by counts."""
