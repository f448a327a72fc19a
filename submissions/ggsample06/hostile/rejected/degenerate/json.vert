{"verdict": "correct", "score": 100}
