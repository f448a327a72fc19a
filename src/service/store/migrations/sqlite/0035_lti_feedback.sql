-- Which feedback was sent beside a score: when it was graded, and how many comments and overrides it has, with the time of the last of
-- each. Of what was sent before nobody knows that; where people judged something, it is sent once more.
ALTER TABLE lti_scores ADD COLUMN feedback TEXT NOT NULL DEFAULT '';
UPDATE lti_scores SET feedback =
    coalesce((SELECT r.graded_at || ' 0 0 0 0' FROM reports r WHERE r.submission_id = lti_scores.submission_id), '');
