"""What tests of several folders need; nothing here asserts."""
