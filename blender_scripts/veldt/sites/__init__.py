"""Places where people live: camps, villages and posts, laid out by the rules of `assets/sites`."""
