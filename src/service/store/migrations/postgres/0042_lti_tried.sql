-- What a platform did not take: a score that has changed since does not wait for the next try. Nothing while one is being sent.
ALTER TABLE lti_scores ADD COLUMN tried_id TEXT;
ALTER TABLE lti_scores ADD COLUMN tried_score DOUBLE PRECISION;
ALTER TABLE lti_scores ADD COLUMN tried_feedback TEXT;
