import pytest


@pytest.fixture(autouse=True, scope="session")
def _ros(ros_environment):
    """Every test here talks on the domain of this session."""
