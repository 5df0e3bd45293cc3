"""Navigation with a card on the chest (Cheng 2024, paper 003)."""

from pdr_core.chest.navigator import ChestEstimate, ChestNavigator, ChestStep, Wanted

__all__ = ["ChestEstimate", "ChestNavigator", "ChestStep", "Wanted"]
