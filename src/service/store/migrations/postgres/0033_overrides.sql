-- What the line of the rubric gave at most when it was overridden; none where that was before it was kept.
ALTER TABLE overrides ADD COLUMN most DOUBLE PRECISION;

-- What a submission had when the results of a regrading took the place of the reports, and its score from then on, with the points
-- that people gave. None until then.
ALTER TABLE regraded ADD COLUMN verdict_before TEXT;
ALTER TABLE regraded ADD COLUMN score_before DOUBLE PRECISION;
ALTER TABLE regraded ADD COLUMN mistakes_before TEXT;
ALTER TABLE regraded ADD COLUMN score_adopted DOUBLE PRECISION;
