-- Paths begin at the archive. Earlier ones begin at the temporary file in which it was read: `/tmp/.tmpAbC123.zip/`, whose
-- name has six characters after `.tmp`.
UPDATE batch_entries SET path = substr(path, strpos(path, '/.tmp') + 16) WHERE path LIKE '/%/.tmp______.zip/%';
UPDATE batches SET refused = replace(refused, substr(refused, strpos(refused, '"path":"/') + 8,
    strpos(refused, '/.tmp') + 16 - strpos(refused, '"path":"/') - 8), '')
    WHERE refused LIKE '%"path":"/%/.tmp______.zip/%';
UPDATE batches SET refused = replace(refused, substr(refused, strpos(refused, '"path":"/') + 8,
    strpos(refused, '/.tmp') + 15 - strpos(refused, '"path":"/') - 8), title || '.zip')
    WHERE refused LIKE '%"path":"/%/.tmp______.zip"%';
UPDATE batches SET title = 'archive' WHERE title LIKE '.tmp______';

-- What came of a request with an Idempotency-Key, so that the same request, sent again, is not carried out again.
CREATE TABLE idempotency_keys (
    -- A hash of the key, of who sent it and of what for.
    id            TEXT PRIMARY KEY,
    -- A hash of what was sent with it.
    fingerprint   TEXT NOT NULL,
    submission_id TEXT REFERENCES submissions (id) ON DELETE CASCADE,
    batch_id      TEXT REFERENCES batches (id) ON DELETE CASCADE,
    created_at    BIGINT NOT NULL
);
CREATE INDEX idempotency_keys_of_submission ON idempotency_keys (submission_id);
CREATE INDEX idempotency_keys_of_batch ON idempotency_keys (batch_id);
CREATE INDEX idempotency_keys_by_time ON idempotency_keys (created_at);
